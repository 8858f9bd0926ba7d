#include "wear/edge.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cassert>
#include <map>
#include <numeric>
#include <utility>

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

Eigen::MatrixX2i flank_neighbours(const reduction::ContactNodes& contact) {
  Eigen::MatrixX2i neighbours = Eigen::MatrixX2i::Constant(contact.count(), 2, -1);
  std::map<int, std::vector<int>> flanks;
  for (int i = 0; i < contact.count(); ++i)
    flanks[contact.group.size() == contact.count() ? contact.group[i] : 0].push_back(i);
  for (const auto& [group, nodes] : flanks) {
    const VectorXd place = place_on_flank(contact, nodes);
    std::vector<std::size_t> order(nodes.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&place](std::size_t a, std::size_t b) {
      return place[static_cast<Index>(a)] < place[static_cast<Index>(b)];
    });
    for (std::size_t i = 0; i + 1 < order.size(); ++i) {
      neighbours(nodes[order[i]], 1) = nodes[order[i + 1]];
      neighbours(nodes[order[i + 1]], 0) = nodes[order[i]];
    }
  }
  return neighbours;
}

std::vector<Edge> find_edges(const reduction::ContactNodes& contact, const std::vector<bool>& released,
                             const std::vector<bool>& loaded, const Eigen::VectorXd& margin) {
  const Eigen::MatrixX2i neighbours = flank_neighbours(contact);
  std::vector<Edge> edges;
  for (int node = 0; node < contact.count(); ++node) {
    if (!released[static_cast<std::size_t>(node)]) continue;
    int stuck = -1;
    for (int side = 0; side < 2; ++side) {
      const int next = neighbours(node, side);
      if (next < 0 || released[static_cast<std::size_t>(next)] || !loaded[static_cast<std::size_t>(next)]) continue;
      if (stuck < 0 || margin[next] < margin[stuck]) stuck = next;
    }
    if (stuck < 0) continue;
    edges.push_back({.worn = node, .stuck = stuck, .margin = std::max(0.0, margin[stuck])});
  }
  return edges;
}

Eigen::VectorXd interpolate_edges(const std::vector<Edge>& edges, const Eigen::VectorXd& found,
                                  const std::vector<EdgeStates>& states) {
  assert(edges.size() == states.size());
  VectorXd depth = found;
  for (std::size_t i = 0; i < edges.size(); ++i)
    depth += edges[i].held_weight() * (states[i].held - found) + edges[i].next_weight() * (states[i].next - found);
  return depth.cwiseMax(0.0);
}

}  // namespace dovetail::wear
