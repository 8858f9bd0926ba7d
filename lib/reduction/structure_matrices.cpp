#include "reduction/structure_matrices.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "core/errors.hpp"
#include "reduction/matrix_market.hpp"
#include "reduction/matrix_text.hpp"
#include "reduction/params.hpp"
#include "reduction/user_element.hpp"

namespace dovetail::reduction {

namespace {

constexpr std::string_view kBlanks = " ,\t\r\f\v";
constexpr std::int64_t kMost = std::numeric_limits<int>::max();
constexpr const char* kKind = "matrix";

/// An entry of a matrix as a file has it.
struct Entry {
  NodeDirection row, column;  ///< without labels: `node` is the row, from 1, and `direction` 0
  double value = 0;
  int line = 0;
};
struct FileMatrix {
  std::string path;
  std::vector<Entry> entries;
  bool labelled = false;
  std::int64_t rows = 0;  ///< 0: not said
};

/// Lines of five words, or of three.
FileMatrix read_lines(const std::string& path, const std::string& text) {
  FileMatrix matrix{.path = path, .entries = {}};
  MatrixText lines(path, kKind, text, kBlanks, '*');
  std::size_t words = 0;
  while (lines.next()) {
    if (words == 0) {
      words = lines.count();
      matrix.labelled = words == 5;
      if (words != 5 && words != 3)
        lines.refuse(lines.line(), std::to_string(words) + " words",
                     "must be node, direction, node, direction, value, or row, column, value, or Matrix Market");
    }
    lines.require(words, matrix.labelled ? "node, direction, node, direction, value" : "row, column, value");
    Entry entry{.row = {}, .column = {}, .value = lines.real(words - 1), .line = lines.line()};
    if (matrix.labelled) {
      // Codes give nodes that they add themselves negative numbers.
      entry.row = {lines.whole(0, -kMost, kMost, "a node"), static_cast<int>(lines.whole(1, 1, 100, "a direction"))};
      entry.column = {lines.whole(2, -kMost, kMost, "a node"), static_cast<int>(lines.whole(3, 1, 100, "a direction"))};
    } else {
      entry.row = {lines.whole(0, 1, kMost, "a row"), 0};
      entry.column = {lines.whole(1, 1, kMost, "a column"), 0};
    }
    matrix.entries.push_back(entry);
  }
  if (words == 0) lines.refuse(0, "", "holds no entries");
  return matrix;
}

FileMatrix read_matrix(const std::string& path, const std::string& text) {
  if (!text.starts_with("%%")) return read_lines(path, text);
  const MatrixEntries market = read_matrix_market_entries(path, text);
  FileMatrix matrix{.path = path, .entries = {}, .rows = market.rows};
  for (const MatrixEntries::Entry& entry : market.entries)
    matrix.entries.push_back({{entry.row + 1, 0}, {entry.column + 1, 0}, entry.value, entry.line});
  return matrix;
}

[[noreturn]] void refuse(const std::string& path, int line, const std::string& value, const std::string& allowed) {
  throw InputError({.file = path, .line = line, .key = kKind, .value = value, .allowed = allowed});
}

std::vector<NodeDirection> read_dofs(const std::string& path) {
  const std::string text = matrix_file_text(path);
  MatrixText lines(path, "degrees of freedom", text, " ,.\t\r\f\v", '*');
  std::vector<NodeDirection> dofs;
  while (lines.next()) {
    lines.require(2, "node.direction");
    dofs.push_back({lines.whole(0, -kMost, kMost, "a node"), static_cast<int>(lines.whole(1, 1, 100, "a direction"))});
  }
  if (std::set(dofs.begin(), dofs.end()).size() != dofs.size())
    lines.refuse(0, {}, "names a direction of a node twice");
  return dofs;
}

using RowOf = std::map<NodeDirection, int>;

/// Both triangles of a matrix of which a file lists one or both.
Eigen::SparseMatrix<double> symmetric_of(FileMatrix& matrix, const RowOf& row_of) {
  const auto n = static_cast<Eigen::Index>(row_of.size());
  std::vector<Eigen::Triplet<double>> triplets;
  bool below = false, above = false;
  std::ranges::stable_sort(matrix.entries, {}, [](const Entry& e) { return std::pair(e.row, e.column); });
  for (std::size_t i = 0; i < matrix.entries.size(); ++i) {
    const Entry& entry = matrix.entries[i];
    const auto row = row_of.find(entry.row), column = row_of.find(entry.column);
    if (row == row_of.end() || column == row_of.end())
      refuse(matrix.path, entry.line, std::to_string((row == row_of.end() ? entry.row : entry.column).node),
             "must be one of the " + std::to_string(n) + " rows");
    if (i > 0 && matrix.entries[i - 1].row == entry.row && matrix.entries[i - 1].column == entry.column)
      refuse(matrix.path, entry.line, {}, "must be an entry not listed before");
    below = below || row->second > column->second;
    above = above || row->second < column->second;
    triplets.emplace_back(row->second, column->second, entry.value);
  }
  Eigen::SparseMatrix<double> listed(n, n);
  listed.setFromTriplets(triplets.begin(), triplets.end());
  const Eigen::SparseMatrix<double> mirrored = listed.transpose();
  if (!(below && above)) {
    const Eigen::SparseMatrix<double> other = mirrored - Eigen::SparseMatrix<double>(listed.diagonal().asDiagonal());
    return listed + other;
  }
  const auto largest = [](const Eigen::SparseMatrix<double>& m) {
    return m.nonZeros() > 0 ? m.coeffs().abs().maxCoeff() : 0.0;
  };
  if (largest(listed - mirrored) > ModelFileParams{}.asymmetry * largest(listed))
    refuse(matrix.path, 0, {}, "must be symmetric: one triangle, or both alike");
  return 0.5 * (listed + mirrored);
}

/// Without the degrees of freedom that are held.
void leave_out_held(StructureMatrices& structure) {
  const Eigen::VectorXd diagonal = structure.stiffness.diagonal();
  std::vector<Eigen::Triplet<double>> kept;
  std::vector<NodeDirection> dofs;
  for (Eigen::Index i = 0; i < diagonal.size(); ++i) {
    if (diagonal(i) >= ModelFileParams{}.held) continue;
    kept.emplace_back(static_cast<int>(i), static_cast<int>(dofs.size()), 1.0);
    dofs.push_back(structure.dofs[static_cast<std::size_t>(i)]);
  }
  if (dofs.size() == structure.dofs.size()) return;
  Eigen::SparseMatrix<double> choose(diagonal.size(), static_cast<Eigen::Index>(dofs.size()));
  choose.setFromTriplets(kept.begin(), kept.end());
  const Eigen::SparseMatrix<double> across = choose.transpose();
  const auto without = [&](const Eigen::SparseMatrix<double>& matrix) {
    const Eigen::SparseMatrix<double> columns = matrix * choose;
    return Eigen::SparseMatrix<double>(across * columns);
  };
  structure.stiffness = without(structure.stiffness);
  if (structure.mass.rows() > 0) structure.mass = without(structure.mass);
  structure.dofs = std::move(dofs);
}

/// Every label of the matrices, or the rows that a file names.
std::vector<NodeDirection> labels_of(const std::vector<FileMatrix>& matrices, const std::string& dofs) {
  const FileMatrix& first = matrices.front();
  for (const FileMatrix& matrix : matrices)
    if (matrix.labelled != first.labelled)
      refuse(matrix.path, 0, {}, "must name its degrees of freedom as " + first.path + " does");
  if (first.labelled) {
    if (!dofs.empty()) refuse(first.path, 0, {}, "names its degrees of freedom itself; leave out the file of them");
    std::vector<NodeDirection> labels;
    for (const FileMatrix& matrix : matrices)
      for (const Entry& entry : matrix.entries) labels.insert(labels.end(), {entry.row, entry.column});
    std::ranges::sort(labels);
    labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
    return labels;
  }
  if (dofs.empty())
    refuse(first.path, 0, {},
           "does not name its degrees of freedom; give dofs, a file with node.direction of each row");
  std::vector<NodeDirection> labels = read_dofs(dofs);
  for (const FileMatrix& matrix : matrices)
    if (matrix.rows != 0 && matrix.rows != static_cast<std::int64_t>(labels.size()))
      refuse(matrix.path, 0, std::to_string(matrix.rows) + " rows",
             "must be as many as lines of " + dofs + ", " + std::to_string(labels.size()));
  return labels;
}

StructureMatrices superelement(const std::string& stiffness, const std::string& text, const std::string& mass,
                               const std::string& dofs) {
  if (!dofs.empty()) refuse(stiffness, 0, {}, "names its degrees of freedom itself; leave out the file of them");
  UserElement element = read_user_element(stiffness, text);
  if (element.stiffness.size() == 0) refuse(stiffness, 0, {}, "has no *MATRIX, TYPE=STIFFNESS");
  StructureMatrices structure;
  structure.stiffness = element.stiffness.sparseView();
  structure.dofs = element.dofs;
  if (mass.empty()) return structure;
  if (mass != stiffness) element = read_user_element(mass, matrix_file_text(mass));
  if (element.mass.size() == 0) refuse(mass, 0, {}, "has no *MATRIX, TYPE=MASS");
  if (element.dofs != structure.dofs) refuse(mass, 0, {}, "must have the nodes and directions of " + stiffness);
  structure.mass = element.mass.sparseView();
  return structure;
}

StructureMatrices assembled(const std::string& stiffness, const std::string& text, const std::string& mass,
                            const std::string& dofs) {
  std::vector<FileMatrix> matrices{read_matrix(stiffness, text)};
  if (!mass.empty()) matrices.push_back(read_matrix(mass, matrix_file_text(mass)));
  StructureMatrices structure;
  structure.dofs = labels_of(matrices, dofs);
  RowOf row_of;
  for (std::size_t i = 0; i < structure.dofs.size(); ++i)
    row_of.emplace(matrices.front().labelled ? structure.dofs[i] : NodeDirection{static_cast<std::int64_t>(i) + 1, 0},
                   static_cast<int>(i));
  structure.stiffness = symmetric_of(matrices.front(), row_of);
  if (!mass.empty()) structure.mass = symmetric_of(matrices.back(), row_of);
  return structure;
}

}  // namespace

StructureMatrices read_structure(const std::string& stiffness, const std::string& mass, const std::string& dofs) {
  const std::string text = matrix_file_text(stiffness);
  StructureMatrices structure =
      is_user_element(text) ? superelement(stiffness, text, mass, dofs) : assembled(stiffness, text, mass, dofs);
  leave_out_held(structure);
  return structure;
}

std::vector<NodalForce> read_nodal_forces(const std::string& path) {
  const std::string text = matrix_file_text(path);
  MatrixText lines(path, "forces", text, kBlanks, '*');
  std::vector<NodalForce> forces;
  while (lines.next()) {
    lines.require(3, "node, direction, value");
    forces.push_back({{lines.whole(0, 1, kMost, "a node"), static_cast<int>(lines.whole(1, 1, 100, "a direction"))},
                      lines.real(2),
                      lines.line()});
  }
  return forces;
}

}  // namespace dovetail::reduction
