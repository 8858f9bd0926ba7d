#pragma once

#include <Eigen/Core>

#include "reduction/reduced_model.hpp"

namespace dovetail::work_precision {

/// A square patch of contact nodes on an elastic body, in the form the massless-boundary reduction delivers: contact
/// coordinates without mass behind their residual flexibility G, and free modes with unit mass,
///   K = [[G^-1, -G^-1 Phi], [-Phi^T G^-1, Lambda + Phi^T G^-1 Phi]],  M = diag(0, I),  C modal on M.
/// G is that of a half-space smoothed over a node's area, so every node feels every other one; Phi are smooth waves.
struct PatchOptions {
  Eigen::Index nodes = 100;     ///< >= 1
  Eigen::Index tangential = 2;  ///< tangential directions, 1 or 2
  Eigen::Index modes = 20;      ///< >= 3
  double held = 0.5;            ///< fraction of the nodes pressed so hard that they stay stuck, [0, 1]
  double load = 0.3;            ///< scale of the excitation, > 0
  double friction = 0.3;        ///< mu
};

/// Pressure differs from node to node: with the default load some nodes of the loose part slip and some lift off. The
/// loose part is the edge of the patch, the held one its middle. One output: the first mode's coordinate.
[[nodiscard]] reduction::ReducedModel contact_patch(const PatchOptions& options);

/// Excitation frequency at which the patch is meant to be solved, rad/s: close below its first resonance.
inline constexpr double kPatchFrequency = 0.9;

}  // namespace dovetail::work_precision
