#pragma once

#include "branches/arc.hpp"
#include "steady/state.hpp"

namespace dovetail::paths {

/// Half the peak-to-peak of one output at a point, and what a direction does to it.
struct AmplitudeAt {
  double value = 0;
  double change = 0;  ///< derivative of the value along the direction
  double speed = 0;   ///< of all coefficients of the output along the direction, relative to its vibration
};
[[nodiscard]] AmplitudeAt amplitude_at(const steady::Point& point, const branches::Vector& direction,
                                       Eigen::Index output);

/// Amplitude of one output over the frequency at a converged state, by its tangent, which must be there.
struct AmplitudeSlope {
  double amplitude = 0;
  double slope = 0;  ///< total derivative with respect to omega
  double width = 0;  ///< the range in which the output changes by its own size, rad/s: half a linear peak's, on its top
};
[[nodiscard]] AmplitudeSlope amplitude_slope(const steady::State& state, Eigen::Index output);

}  // namespace dovetail::paths
