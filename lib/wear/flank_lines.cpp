#include "wear/flank_lines.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <map>
#include <numeric>

namespace dovetail::wear {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// Place of every node along the longest direction of its group.
VectorXd place_on_flank(const reduction::ContactNodes& contact, const std::vector<int>& nodes) {
  const auto count = static_cast<Index>(nodes.size());
  VectorXd place = VectorXd::LinSpaced(count, 0.0, static_cast<double>(std::max<Index>(count - 1, 0)));
  if (contact.position.rows() != contact.count() || count < 2) return place;
  Eigen::MatrixX3d points(count, 3);
  for (Index i = 0; i < count; ++i) points.row(i) = contact.position.row(nodes[static_cast<std::size_t>(i)]);
  const Eigen::RowVector3d middle = points.colwise().mean();
  points.rowwise() -= middle;
  const Eigen::Matrix3d spread = points.transpose() * points;
  if (spread.trace() == 0.0) return place;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread);
  return points * axes.eigenvectors().col(2);
}

}  // namespace

std::vector<std::vector<int>> flank_lines(const reduction::ContactNodes& contact) {
  std::map<int, std::vector<int>> flanks;
  for (int i = 0; i < contact.count(); ++i)
    flanks[contact.group.size() == contact.count() ? contact.group[i] : 0].push_back(i);
  std::vector<std::vector<int>> lines;
  for (const auto& [group, nodes] : flanks) {
    const VectorXd place = place_on_flank(contact, nodes);
    std::vector<std::size_t> order(nodes.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&place](std::size_t a, std::size_t b) {
      return place[static_cast<Index>(a)] < place[static_cast<Index>(b)];
    });
    lines.emplace_back();
    for (const std::size_t at : order) lines.back().push_back(nodes[at]);
  }
  return lines;
}

}  // namespace dovetail::wear
