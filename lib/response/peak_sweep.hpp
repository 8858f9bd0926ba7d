#pragma once

#include "response/continuation.hpp"
#include "response/resonance.hpp"

namespace dovetail::response {

/// The highest maximum of the amplitude on the branch between omega_from and omega_to (rad/s): the branch is followed
/// coarsely, through its turning points, and Newton on (U, omega) started from its highest points. Where frequency
/// stepping fails - the peak leans over, or lies far from any guess - this does not, at the cost of some fifty to two
/// hundred points.
[[nodiscard]] Resonance peak_sweep(const std::shared_ptr<const CondensedModel>& model, double omega_from,
                                   double omega_to, const ContactCondition& condition, const SteadyOptions& options,
                                   const ResonanceOptions& resonance_options);

}  // namespace dovetail::response
