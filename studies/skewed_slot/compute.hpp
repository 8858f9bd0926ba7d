#pragma once

#include <functional>

#include "studies/skewed_slot/results.hpp"

namespace dovetail::skewed_slot {

struct ComputeOptions {
  std::vector<double> skew_deg{0, 5, 10, 15, 20};         ///< ascending from 0
  bool wear = true;                                       ///< of the first and the last angle
  std::function<void(const std::string&)> progress = {};  ///< a line for people
};

/// Spin-up of the scene with each angle, on one mesh topology: that of the straight slot. Throws InputError for a scene
/// that violates its ranges; what did not converge says so in its status.
[[nodiscard]] Results compute(const optimizer::Scene& scene, const ComputeOptions& options);

}  // namespace dovetail::skewed_slot
