#include "reduction/stiffness_change.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "numerics/dense_product.hpp"
#include "numerics/sparse_product.hpp"
#include "reduction/params.hpp"

namespace dovetail::reduction {

using Sparse = Eigen::SparseMatrix<double>;

namespace {

/// Those of a matrix that are not negligible.
std::vector<int> rows_that_count(const Sparse& matrix) {
  Eigen::VectorXd largest = Eigen::VectorXd::Zero(matrix.cols());
  for (Eigen::Index column = 0; column < matrix.outerSize(); ++column)
    for (Sparse::InnerIterator entry(matrix, column); entry; ++entry)
      largest(column) = std::max(largest(column), std::abs(entry.value()));
  const double negligible = ChangeParams{}.negligible * largest.maxCoeff();
  std::vector<int> rows;
  for (Eigen::Index column = 0; column < matrix.cols(); ++column)
    if (largest(column) > negligible) rows.push_back(static_cast<int>(column));
  return rows;
}

/// A symmetric matrix on some of its rows.
Eigen::SparseMatrix<double, Eigen::RowMajor> on_rows(const Sparse& matrix, const std::vector<int>& rows) {
  std::vector<int> place(static_cast<std::size_t>(matrix.cols()), -1);
  for (std::size_t i = 0; i < rows.size(); ++i) place[static_cast<std::size_t>(rows[i])] = static_cast<int>(i);
  std::vector<Eigen::Triplet<double>> entries;
  for (const int column : rows)
    for (Sparse::InnerIterator entry(matrix, column); entry; ++entry) {
      // Of a row left out, on the diagonal: a stress does nothing where bodies only move along.
      const int row = place[static_cast<std::size_t>(entry.row())], here = place[static_cast<std::size_t>(column)];
      entries.emplace_back(row >= 0 ? row : here, here, entry.value());
    }
  const auto r = static_cast<Eigen::Index>(rows.size());
  Eigen::SparseMatrix<double, Eigen::RowMajor> result(r, r);
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

}  // namespace

StiffnessChange stiffness_change(const ResidualFlexibility& structure, Sparse change, const Eigen::MatrixXd& forced) {
  StiffnessChange result;
  result.whole.swap(change);
  const Eigen::MatrixXd& phi = structure.basis().vectors;
  const Eigen::Index nt = forced.cols(), m = phi.cols();
  const Eigen::MatrixXd on_phi = numerics::symmetric_product(result.whole, phi);
  result.on_trace.resize(nt + m, nt + m);
  // Fields of contact forces decay: of them the rows count where the change is not negligible.
  const std::vector<int> rows = rows_that_count(result.whole);
  const Eigen::MatrixXd x = forced(rows, Eigen::all);
  const Eigen::MatrixXd changed = numerics::product(on_rows(result.whole, rows), numerics::Rows(x));
  result.on_trace.topLeftCorner(nt, nt) = numerics::transposed_product(x, changed);
  result.on_trace.topRightCorner(nt, m) = numerics::transposed_product(forced, on_phi);
  result.on_trace.bottomLeftCorner(m, nt) = result.on_trace.topRightCorner(nt, m).transpose();
  result.on_trace.bottomRightCorner(m, m) = numerics::transposed_product(phi, on_phi);
  result.on_trace = (0.5 * (result.on_trace + result.on_trace.transpose())).eval();
  return result;
}

Eigen::MatrixXd StiffnessChange::on_contact(const Sparse& average) const {
  const Eigen::Index nc = average.rows(), nt = average.cols(), m = on_trace.rows() - nt;
  const Eigen::MatrixXd averaged = average * on_trace.topRows(nt);  // [nc, nt + m]
  Eigen::MatrixXd result(nc + m, nc + m);
  result.topLeftCorner(nc, nc) = averaged.leftCols(nt) * average.transpose();
  result.topRightCorner(nc, m) = averaged.rightCols(m);
  result.bottomLeftCorner(m, nc) = averaged.rightCols(m).transpose();
  result.bottomRightCorner(m, m) = on_trace.bottomRightCorner(m, m);
  return result;
}

}  // namespace dovetail::reduction
