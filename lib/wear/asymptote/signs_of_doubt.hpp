#pragma once

#include <Eigen/Core>
#include <vector>

#include "wear/release/passes.hpp"

namespace dovetail::wear {

/// Whether two worn states are the same: depths that differ by `tolerance` of the largest at most.
[[nodiscard]] bool same_depth(const Eigen::VectorXd& a, const Eigen::VectorXd& b, double tolerance);

// What tells that a history may end elsewhere than the passes of release.

/// A node that an earlier pass wore deeper than the last one needs lost contact on the way; a history may have worn it
/// before the load came back to others, and ends deeper.
[[nodiscard]] bool reloads(const Eigen::VectorXd& deepest, const Eigen::VectorXd& depth, double tolerance);

/// A node that touches at times only may wear to where it touches without slip, well before it touches nothing.
[[nodiscard]] bool lifts_off(const Passes& passes, const Eigen::VectorXd& depth, double tolerance);

/// A node that sticks with little to spare may slip while its neighbours wear, and the history wears it, too.
[[nodiscard]] bool near_slip(const dynamics::CondensedModel& model, const steady::State& state,
                             const std::vector<bool>& released);

/// Worn nodes unload the others little by little: one that sticks before and after may slip, and wear, in between.
/// Where that cannot be seen the doubt stays.
[[nodiscard]] bool slips_on_the_way(WearingJoint& joint, const steady::State& unworn, const Eigen::VectorXd& depth,
                                    const std::vector<bool>& released);

}  // namespace dovetail::wear
