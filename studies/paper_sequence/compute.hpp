#pragma once

#include <functional>

#include "studies/paper_sequence/results.hpp"

namespace dovetail::paper_sequence {

struct ComputeOptions {
  int curve_points = 81;   ///< >= 3, of each response curve
  int history_steps = 80;  ///< >= 1, largest increment of depth = asymptotic depth / history_steps
  int curve_states = 6;    ///< >= 2, states with response curves, first and last included
  int nodal_diameter_modes = 5;
  double range = 0.0025;  ///< of the frequencies on both sides of the unworn resonance, relative
  std::function<void(const std::string&)> progress = {};  ///< a line for people
};

/// The reference's sequence: frequencies over nodal diameters, preload, response and dissipated power, rates of the
/// first cycle, history at the unworn resonance, asymptote, responses of the wearing joint. Throws InputError for a
/// scene that violates its ranges; what did not converge is in `failures`.
[[nodiscard]] Results compute(const optimizer::Scene& scene, const ComputeOptions& options);

}  // namespace dovetail::paper_sequence
