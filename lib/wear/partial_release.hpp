#pragma once

#include <Eigen/Core>

#include "wear/release.hpp"

namespace dovetail::wear {

/// A worn geometry whose zones end inside elements: the release of `release_slipping` with shares of nodes in [0, 1]
/// instead of yes and no, so that worn geometry and volume are continuous in the design.
///
/// share 0: the node is in contact; share 1: it is worn off and carries nothing; between, it is in contact behind
/// springs of compliance c = share / (1 - share) / k in all directions, k its own stiffness: a node of which a part
/// still bears. The zones grow over the passes by the slip next to them (WornZones).
struct PartialRelease {
  Status status = Status::converged;
  bool settled = false;   ///< nothing outside the zones slips; otherwise the last state found stands for the answer
  Eigen::VectorXd share;  ///< [Nc]
  Eigen::VectorXd depth;  ///< W [Nc], m
  int passes = 0;
  response::SteadyState state;  ///< with these shares
};

/// `unworn`: the state with nothing released. `threshold`: wear per cycle that counts as slip, m. At most `limit`
/// passes. Plane models only. Cost: one steady state per pass, one or two passes as a rule.
[[nodiscard]] PartialRelease release_partially(Release& release, const response::SteadyState& unworn, double threshold,
                                               int limit);

}  // namespace dovetail::wear
