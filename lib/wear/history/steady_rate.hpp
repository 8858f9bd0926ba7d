#pragma once

#include <Eigen/Core>
#include <vector>

#include "steady/state.hpp"

namespace dovetail::wear {

/// One state of a wearing joint.
struct WornRecord {
  double cycles = 0, volume = 0, amplitude = 0, frequency = 0;  ///< m^3, m, rad/s
  Eigen::VectorXd depth, rate;                                  ///< [Nc] m, m per cycle
};

/// Whether no rate fell by more than LevelParams::change, or rose by more than its `rise`, of the largest one while the
/// largest depth doubled to what it is now.
[[nodiscard]] bool unchanged_while_doubling(const std::vector<WornRecord>& records);

/// Whether wearing by `depth` (m, of the fastest node) at the rates of `state` moves no rate by more than
/// LevelParams::change of the largest one, by their exact derivative: loads that do not depend on wear. False where
/// nothing wears or without tangent. Cost: one back substitution per node.
[[nodiscard]] bool insensitive_to_wear(const steady::State& state, double depth);

}  // namespace dovetail::wear
