#pragma once

#include <Eigen/Core>
#include <vector>

#include "steady/state.hpp"

namespace dovetail::wear {

/// When rates have levelled out, so that wear goes on for ever: they stay within kLevelChange of the largest one while
/// the joint wears by kLevelDepth of its largest local penetration (largest_penetration), far beyond the depth over
/// which its pressures change. Rates may rise by more than that, as where a joint that slips all over
/// moves outwards and its centrifugal load grows with the radius: what rises does not come to rest.
inline constexpr double kLevelDepth = 300.0;
inline constexpr double kLevelChange = 1e-3;
inline constexpr double kLevelRise = 0.05;

/// One state of a wearing joint.
struct WornRecord {
  double cycles = 0, volume = 0, amplitude = 0, frequency = 0;  ///< m^3, m, rad/s
  Eigen::VectorXd depth, rate;                                  ///< [Nc] m, m per cycle
};

/// Whether no rate fell by more than `change`, or rose by more than kLevelRise, of the largest one while the largest
/// depth doubled to what it is now.
[[nodiscard]] bool unchanged_while_doubling(const std::vector<WornRecord>& records, double change);

/// Whether wearing by `depth` (m, of the fastest node) at the rates of `state` moves no rate by more than `change` of
/// the largest one, by their exact derivative: loads that do not depend on wear. False where nothing wears or without
/// tangent. Cost: one back substitution per node.
[[nodiscard]] bool insensitive_to_wear(const steady::State& state, double depth, double change);

}  // namespace dovetail::wear
