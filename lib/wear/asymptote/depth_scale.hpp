#pragma once

#include "steady/state.hpp"
#include "wear/watcher.hpp"

namespace dovetail::wear {

/// The depth that increments of a history are measured by.
struct DepthScale {
  Status status = Status::converged;
  double depth = 0.0;     ///< m
  bool released = false;  ///< the largest depth of the released state; otherwise the largest local penetration
  int solves = 0, jacobians = 0;
};

/// The largest depth of the state that release comes to, as a guess of where a history ends. Where release comes to no
/// end, as in sliding under a dead load, the largest local penetration of the unworn contact, lambda_N over the node's
/// own stiffness: the depth over which pressures change. Zero where nothing wears.
/// - `rate_threshold`: wear per cycle that counts as none, m
/// - `unworn`: steady state of `joint` at omega to begin with, or null
///
/// Cost: that of a direct asymptote without certificate or arbitration, 3 to 10 steady states.
[[nodiscard]] DepthScale depth_scale(const steady::Joint& joint, double omega, double rate_threshold,
                                     const steady::State* unworn = nullptr, const Watcher& watcher = {});

}  // namespace dovetail::wear
