#pragma once

#include <Eigen/Core>
#include <span>

#include "fem/mesh.hpp"

namespace dovetail::fem {

/// Quadrature weights of nodes along the boundary sides whose nodes are all in `nodes`: in the plane three-node edges
/// (weights in m), in space the nine-node sides of wedges (m^2; their triangular ends do not count). Simpson's rule on
/// every curved side: sum_k weight_k f(node_k) approximates the line (surface) integral of f. Zero for
/// nodes on no such side. Throws InputError when there is no such side at all.
[[nodiscard]] Eigen::VectorXd boundary_weights(const Mesh& mesh, std::span<const int> nodes);

/// Unit normals [d, nodes] of those sides at the same nodes, means where sides meet at an angle; 0 for nodes on none.
[[nodiscard]] Eigen::MatrixXd boundary_normals(const Mesh& mesh, std::span<const int> nodes);

struct AggregateOptions {
  /// p, 1/Pa, > 0: stresses within 1/p of the peak count as peak. Larger follows the maximum more
  /// closely and is harder on an optimiser.
  double sharpness = 2e-7;
  /// l, fraction of the line's length (the surface's area), 0 < l <= 1: the width a peak is expected to have.
  double peak_fraction = 0.1;
};

struct Aggregate {
  double value = 0;          ///< Pa
  double maximum = 0;        ///< the largest nodal value, Pa
  Eigen::VectorXd gradient;  ///< d value / d stress_k, non-negative, sums to 1
};

/// Kreisselmeier-Steinhauser aggregate in its integral form, which converges with the mesh:
///
///   KS = (1/p) ln( 1/(l L) integral exp(p sigma) ds ),   L the length of the line or area of the surface.
///
/// KS exceeds the maximum by at most ln(1/l)/p (reached when the stress is uniform) and falls below it when
/// the part of the line within about 1/p of the peak is shorter than l L. Smooth in the stresses.
/// [Kreisselmeier & Steinhauser 1979]. `weights` from boundary_weights.
[[nodiscard]] Aggregate kreisselmeier_steinhauser(const Eigen::Ref<const Eigen::VectorXd>& stress,
                                                  const Eigen::Ref<const Eigen::VectorXd>& weights,
                                                  const AggregateOptions& options = {});

}  // namespace dovetail::fem
