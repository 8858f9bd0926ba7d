#pragma once

#include <Eigen/Core>
#include <vector>

#include "steady/state.hpp"

namespace dovetail::wear {

/// Friction margin of a node over the period, min_{t,s} 1 - |lambda_T(t) - lambda_T(s)| / (limit(t) + limit(s))
/// of the tangential force, over its loaded samples: what is left before no constant residual traction keeps it from
/// slipping in every cycle. (Its distance from the limit at one instant says nothing: a node that slid into place sits
/// there.) Negative for a node held beyond its friction; infinite without load or friction. O(samples^2).
[[nodiscard]] double friction_margin(const steady::State& state, Eigen::Index node, const contact::NodeLaw& law);

/// What a node has left of its friction: the margin of one that sticks (friction_margin), minus the overload that one
/// that slips relieves by slipping, both in units of mu lambda_N and zero at the edge between the two; NaN of one
/// without load.
[[nodiscard]] Eigen::VectorXd friction_reserve(const dynamics::CondensedModel& model, const steady::State& state,
                                               const std::vector<bool>& slips);

}  // namespace dovetail::wear
