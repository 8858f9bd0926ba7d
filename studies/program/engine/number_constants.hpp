#pragma once

#include <limits>
#include <numbers>

namespace dovetail::studies {

inline constexpr double kTurn = 2 * std::numbers::pi;                         ///< rad/s of 1 Hz
inline constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();  ///< null in an answer

}  // namespace dovetail::studies
