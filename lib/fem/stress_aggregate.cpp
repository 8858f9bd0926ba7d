#include "fem/stress_aggregate.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <type_traits>
#include <vector>

#include "core/errors.hpp"
#include "fem/element.hpp"

namespace dovetail::fem {

namespace {

/// d/ds of the quadratic through three values at s = 0, 1/2, 1, at these places.
template <class Vector>
std::array<Vector, 3> slopes(const Vector& a, const Vector& m, const Vector& b) {
  return {-3 * a + 4 * m - b, b - a, a - 4 * m + 3 * b};
}

constexpr std::array<double, 3> kSimpson{1.0 / 6, 4.0 / 6, 1.0 / 6};

/// The normal at the three nodes of an edge, as long as their weights.
std::array<Eigen::Vector2d, 3> side_normals(const Mesh& mesh, const std::array<int, 3>& nodes) {
  const auto at = [&](std::size_t k) { return Eigen::Vector2d(mesh.nodes.col(nodes[k])); };
  const std::array<Eigen::Vector2d, 3> slope = slopes(at(0), at(1), at(2));
  std::array<Eigen::Vector2d, 3> normals;
  for (std::size_t k = 0; k < 3; ++k) normals[k] = kSimpson[k] * Eigen::Vector2d(slope[k].y(), -slope[k].x());
  return normals;
}

/// The same at the nine nodes of a side.
std::array<Eigen::Vector3d, 9> side_normals(const Mesh& mesh, const std::array<int, 9>& nodes) {
  const auto at = [&](std::size_t row, std::size_t k) { return Eigen::Vector3d(mesh.nodes.col(nodes[3 * row + k])); };
  std::array<std::array<Eigen::Vector3d, 3>, 3> along, across;  // [row][k], [k][row]
  for (std::size_t k = 0; k < 3; ++k) {
    along[k] = slopes(at(k, 0), at(k, 1), at(k, 2));
    across[k] = slopes(at(0, k), at(1, k), at(2, k));
  }
  std::array<Eigen::Vector3d, 9> normals;
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t k = 0; k < 3; ++k)
      normals[3 * row + k] = kSimpson[row] * kSimpson[k] * along[row][k].cross(across[k][row]);
  return normals;
}

struct Boundary {
  Eigen::VectorXd weights;  // [nodes]
  Eigen::MatrixXd normals;  // [d, nodes], of unit length; 0 for nodes on no side
};

Boundary boundary_of(const Mesh& mesh, std::span<const int> nodes) {
  std::vector<int> slot(static_cast<std::size_t>(mesh.node_count()), -1);
  for (std::size_t k = 0; k < nodes.size(); ++k) slot[static_cast<std::size_t>(nodes[k])] = static_cast<int>(k);
  const auto slot_of = [&](int node) { return slot[static_cast<std::size_t>(node)]; };

  const auto count = static_cast<Eigen::Index>(nodes.size());
  Boundary boundary{.weights = Eigen::VectorXd::Zero(count),
                    .normals = Eigen::MatrixXd::Zero(mesh.dimensions(), count)};
  with_element(mesh.kind, [&]<class Element>(Element) {
    // Sides within the list, by their middle node; seen from two elements they are inside the body.
    using Side = typename std::decay_t<decltype(Element::sides())>::value_type;
    struct Use {
      Side nodes;
      int elements = 0;
    };
    std::map<int, Use> used;
    for (int e = 0; e < mesh.element_count(); ++e) {
      const std::span<const int> element = mesh.element(e);
      for (const Side& local : Element::sides()) {
        Side side;
        for (std::size_t k = 0; k < side.size(); ++k) side[k] = element[static_cast<std::size_t>(local[k])];
        if (std::any_of(side.begin(), side.end(), [&](int node) { return slot_of(node) < 0; })) continue;
        ++used.try_emplace(side[side.size() / 2], Use{side}).first->second.elements;
      }
    }
    for (const auto& [middle, use] : used) {
      if (use.elements != 1) continue;
      const auto normals = side_normals(mesh, use.nodes);
      for (std::size_t k = 0; k < use.nodes.size(); ++k) {
        boundary.weights[slot_of(use.nodes[k])] += normals[k].norm();
        boundary.normals.col(slot_of(use.nodes[k])) += normals[k];
      }
    }
  });
  if (!(boundary.weights.sum() > 0))
    throw InputError({.file = {},
                      .key = "nodes",
                      .value = std::to_string(nodes.size()) + " nodes",
                      .allowed = "must contain all nodes of boundary sides of elements"});
  boundary.normals.colwise().normalize();
  return boundary;
}

}  // namespace

Eigen::VectorXd boundary_weights(const Mesh& mesh, std::span<const int> nodes) {
  return boundary_of(mesh, nodes).weights;
}

Eigen::MatrixXd boundary_normals(const Mesh& mesh, std::span<const int> nodes) {
  return boundary_of(mesh, nodes).normals;
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
  return result;
}

}  // namespace dovetail::fem
