#pragma once

#include <cmath>

#include "bowl.hpp"

namespace dovetail::optimizer {

/// Two bowls that are wanted low each, x^2 + y^2 and (x - 2)^2 + y^2, over [-1, 3] x [-1, 1], with x >= 1/2. The front
/// is y = 0, 1/2 <= x <= 2: sqrt(near) + sqrt(far) = 2. Against (4, 4) its hypervolume is the integral of 4 - (2 -
/// sqrt(f))^2 from 1/4 to 4.
inline Problem two_bowls() {
  Problem problem;
  problem.front = true;
  problem.space = DesignSpace(
      {{.key = "x", .lower = -1, .upper = 3, .start = 2.5}, {.key = "y", .lower = -1, .upper = 1, .start = 0.5}});
  problem.objective = {{.response = "near", .reference = 4}, {.response = "far", .reference = 4}};
  problem.constraints = {{.response = "x", .lower = 0.5, .upper = {}}};
  return problem;
}
inline constexpr double kTwoBowls = 13.03125;

inline Evaluation two_bowls_at(std::span<const double> x) {
  Evaluation e;
  e.responses = {{"near", x[0] * x[0] + x[1] * x[1]}, {"far", std::pow(x[0] - 2, 2) + x[1] * x[1]}, {"x", x[0]}};
  return e;
}

/// A rule is broken in one corner and everything fails in a strip across the front.
inline Evaluation two_rough_bowls_at(std::span<const double> x) {
  if (x[0] + x[1] < -1) return broken(-1 - x[0] - x[1]);
  if (x[0] > 1.2 && x[0] < 1.3) return failed();
  return two_bowls_at(x);
}

}  // namespace dovetail::optimizer
