#pragma once

#include <Eigen/Core>

#include "steady/state.hpp"
#include "wear/watcher.hpp"

namespace dovetail::wear {

/// The end of a history by the direct method.
struct Finish {
  bool done = false;      ///< nodes were released, and the state reached is close to the one given
  Eigen::VectorXd depth;  ///< [Nc] m
  steady::State steady;   ///< with that depth and contact everywhere
  int solves = 0;
  int jacobians = 0;
};

/// Releases the nodes that would go on wearing: where nodes touch at times only, rates die out like a power of the
/// cycles and leave depth to be worn after any of them. A node counts when its rate times the cycles so far is more
/// than 1e-5 of the largest depth. Not done where releasing them moves any depth by more than `close` of the largest,
/// or by more than their rates can still wear, a few times rate times cycles: then the nodes carry what others would
/// have to take over, they come to rest in contact, and the history is better left as it is.
[[nodiscard]] Finish finish_by_release(const steady::Joint& joint, const steady::State& state,
                                       const Eigen::VectorXd& depth, double cycles, double close,
                                       const Watcher& watcher);

}  // namespace dovetail::wear
