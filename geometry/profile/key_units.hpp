#pragma once

#include <numbers>

#include "core/options.hpp"

// What lengths and angles are written in for users, and how the tables of keys say a range.
namespace dovetail::geometry {

inline constexpr double kMillimetre = 1e-3;
inline constexpr double kMicrometre = 1e-6;
inline constexpr double kDegree = std::numbers::pi / 180.0;

/// lower <= value <= upper.
[[nodiscard]] constexpr Range between(double lower, double upper) {
  return {.lower = lower, .upper = upper};
}

}  // namespace dovetail::geometry
