#pragma once

#include "paths/resonance.hpp"

namespace dovetail::paths {

/// Maxima of the sampled equations lie about one peak, that much different in height, relative.
[[nodiscard]] inline double noise_of_peaks(const steady::Options& options) {
  return 1.0 / options.samples;
}

/// The highest maximum of the amplitude on the branch between `low` and `high` (rad/s): the branch is followed
/// coarsely, through its turning points, and Newton on (U, omega) started from its highest points; where that runs off
/// to a lower maximum, the slope is bracketed between the neighbours of the point. Downwards first; upwards as well
/// when the branch is not found at `high` or leaves its highest point unresolved. Where frequency stepping fails - the
/// peak leans over, or lies far from any guess - this does not, at the cost of some fifty to two hundred points.
[[nodiscard]] Resonance peak_sweep(const steady::Joint& joint, double low, double high,
                                   const ResonanceOptions& resonance_options);

}  // namespace dovetail::paths
