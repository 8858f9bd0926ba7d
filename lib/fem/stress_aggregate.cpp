#include "fem/stress_aggregate.hpp"

#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/errors.hpp"

namespace dovetail::fem {

Eigen::VectorXd boundary_weights(const Mesh& mesh, std::span<const int> nodes) {
  std::vector<int> slot(static_cast<std::size_t>(mesh.node_count()), -1);
  for (std::size_t k = 0; k < nodes.size(); ++k) slot[static_cast<std::size_t>(nodes[k])] = static_cast<int>(k);
  const auto slot_of = [&](int node) { return slot[static_cast<std::size_t>(node)]; };

  // Edges within the list, by mid-side node; seen from two sides they are inside the body.
  struct Edge {
    int start, end, sides;
  };
  std::map<int, Edge> edges;
  for (const std::array<int, 6>& element : mesh.elements)
    for (std::size_t side = 0; side < 3; ++side) {
      const int start = element[side], end = element[(side + 1) % 3], middle = element[3 + side];
      if (slot_of(start) < 0 || slot_of(end) < 0 || slot_of(middle) < 0) continue;
      const auto [edge, added] = edges.try_emplace(middle, Edge{start, end, 0});
      ++edge->second.sides;
    }

  Eigen::VectorXd weights = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(nodes.size()));
  for (const auto& [middle, edge] : edges) {
    if (edge.sides != 1) continue;
    const Eigen::Vector2d a = mesh.nodes.col(edge.start), m = mesh.nodes.col(middle), b = mesh.nodes.col(edge.end);
    // |dr/ds| of the quadratic edge at s = 0, 1/2, 1.
    weights[slot_of(edge.start)] += (-3 * a + 4 * m - b).norm() / 6;
    weights[slot_of(middle)] += (b - a).norm() * 4 / 6;
    weights[slot_of(edge.end)] += (a - 4 * m + 3 * b).norm() / 6;
  }
  if (!(weights.sum() > 0))
    throw InputError({.file = {},
                      .key = "nodes",
                      .value = std::to_string(nodes.size()) + " nodes",
                      .allowed = "must contain whole boundary edges (two corners and the mid-side node)"});
  return weights;
}

Aggregate kreisselmeier_steinhauser(const Eigen::Ref<const Eigen::VectorXd>& stress,
                                    const Eigen::Ref<const Eigen::VectorXd>& weights, const AggregateOptions& options) {
  assert(stress.size() == weights.size() && options.sharpness > 0);
  assert(options.peak_fraction > 0 && options.peak_fraction <= 1);
  Aggregate result;
  result.maximum = -std::numeric_limits<double>::infinity();
  for (Eigen::Index k = 0; k < stress.size(); ++k)
    if (weights[k] > 0) result.maximum = std::max(result.maximum, stress[k]);
  // Relative to the maximum nothing overflows.
  result.gradient = weights.array() * (options.sharpness * (stress.array() - result.maximum)).min(0.0).exp();
  const double sum = result.gradient.sum();
  result.gradient /= sum;
  result.value = result.maximum + std::log(sum / (options.peak_fraction * weights.sum())) / options.sharpness;
  result.overestimate = -std::log(options.peak_fraction) / options.sharpness;
  return result;
}

}  // namespace dovetail::fem
