#include "reduction/node_pairs.hpp"

#include <Eigen/Geometry>
#include <map>
#include <set>
#include <string>

#include "core/errors.hpp"

namespace dovetail::reduction {

namespace {

std::string at(const char* key, std::size_t pair) {
  return std::string(key) + "[" + std::to_string(pair) + "]";
}

/// Orthonormal rows N, T1[, T2].
Eigen::MatrixXd directions_of(const NodePairs& pairs, std::size_t pair, std::vector<Violation>& found) {
  const auto row = static_cast<Eigen::Index>(pair);
  const Eigen::Index d = pairs.normal.cols();
  Eigen::MatrixXd rows = Eigen::MatrixXd::Identity(d, d);
  const Eigen::VectorXd normal = pairs.normal.row(row);
  if (!(normal.norm() > 0) || !normal.allFinite()) {
    found.push_back({.file = {}, .key = at("normal", pair), .value = {}, .allowed = "must have a direction"});
    return rows;
  }
  rows.row(0) = normal.normalized();
  if (d == 2) {
    rows.row(1) << -rows(0, 1), rows(0, 0);
    return rows;
  }
  Eigen::VectorXd tangent = Eigen::VectorXd::Zero(d);
  if (pairs.tangent.rows() > 0) {
    tangent = pairs.tangent.row(row);
  } else {
    Eigen::Index flattest = 0;
    normal.cwiseAbs().minCoeff(&flattest);
    tangent(flattest) = 1;
  }
  constexpr double kParallel = 1e-6;  // what is left beside the normal is rounding of the file's digits
  const double size = tangent.norm();
  tangent -= rows.row(0).dot(tangent) * rows.row(0).transpose();
  if (!(tangent.norm() > kParallel * size)) {
    found.push_back({.file = {}, .key = at("tangent", pair), .value = {}, .allowed = "must differ from the normal"});
    return rows;
  }
  rows.row(1) = tangent.normalized();
  rows.row(2) = Eigen::Vector3d(rows.row(0)).cross(Eigen::Vector3d(rows.row(1)));
  return rows;
}

}  // namespace

Eigen::SparseMatrix<double> relative_coordinates(std::span<const NodeDirection> dofs, const NodePairs& pairs) {
  const auto d = static_cast<int>(pairs.normal.cols());
  std::vector<Violation> found;
  const auto wrong = [&](const std::string& key, std::int64_t node, const std::string& allowed) {
    found.push_back({.file = {}, .key = key, .value = std::to_string(node), .allowed = allowed});
  };
  std::map<NodeDirection, int> row_of;
  for (std::size_t i = 0; i < dofs.size(); ++i) row_of.emplace(dofs[i], static_cast<int>(i));
  const std::set<std::int64_t> paired(pairs.nodes.begin(), pairs.nodes.end());
  const auto has_all = [&](std::int64_t node) {
    for (int k = 1; k <= d; ++k)
      if (!row_of.contains({node, k})) return false;
    return true;
  };

  // The rest keeps its order; coordinates of pairs follow.
  std::vector<int> column(dofs.size(), -1);
  int rest = 0;
  for (std::size_t i = 0; i < dofs.size(); ++i)
    if (!paired.contains(dofs[i].node) || dofs[i].direction > d) column[i] = rest++;
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t i = 0; i < dofs.size(); ++i)
    if (column[i] >= 0) entries.emplace_back(static_cast<int>(i), column[i], 1.0);

  std::set<std::int64_t> seen;
  for (std::size_t p = 0; p < pairs.nodes.size(); ++p) {
    const std::int64_t node = pairs.nodes[p], other = pairs.against.empty() ? 0 : pairs.against[p];
    if (!seen.insert(node).second) wrong(at("nodes", p), node, "must not be listed twice");
    if (!has_all(node)) {
      wrong(at("nodes", p), node, "must be a node that the matrices have in directions 1 to " + std::to_string(d));
      continue;
    }
    if (other != 0 && paired.contains(other)) wrong(at("against", p), other, "must not be one of nodes, too");
    bool any = false;
    const Eigen::MatrixXd frame = directions_of(pairs, p, found);
    for (int k = 0; k < d; ++k) {
      const int row = row_of.at({node, k + 1});
      // A direction in which the other node is held is ground.
      if (const auto beside = row_of.find({other, k + 1}); other != 0 && beside != row_of.end()) {
        any = true;
        if (const int place = column[static_cast<std::size_t>(beside->second)]; place >= 0)
          entries.emplace_back(row, place, 1.0);
      }
      for (int r = 0; r < d; ++r) entries.emplace_back(row, rest + d * static_cast<int>(p) + r, frame(r, k));
    }
    if (other != 0 && !any) wrong(at("against", p), other, "must be a node of the matrices, or 0 for rigid ground");
  }
  if (!found.empty()) throw InputError(std::move(found));
  Eigen::SparseMatrix<double> to_dofs(static_cast<Eigen::Index>(dofs.size()),
                                      rest + d * static_cast<Eigen::Index>(pairs.nodes.size()));
  to_dofs.setFromTriplets(entries.begin(), entries.end());
  return to_dofs;
}

}  // namespace dovetail::reduction
