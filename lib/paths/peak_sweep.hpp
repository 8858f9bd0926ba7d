#pragma once

#include <optional>

#include "branches/branch.hpp"
#include "paths/resonance.hpp"

namespace dovetail::paths {

/// The maximum of the branch beside a converged point near it, by Newton on (U, omega), which turning points do not
/// stop; nothing when there is none as high as 0.99 of the point. `width`: the frequency range in which the output
/// changes by its own size there. Where the branch turns away it begins anew, a few times. Counts its work in `work`.
[[nodiscard]] std::optional<steady::State> climb(const branches::Equations& equations, const steady::State& from,
                                                 double width, const ResonanceOptions& options, Resonance& work);

/// The highest maximum of the amplitude on the branch between omega_from and omega_to (rad/s): the branch is followed
/// coarsely, through its turning points, and Newton on (U, omega) started from its highest points. Where frequency
/// stepping fails - the peak leans over, or lies far from any guess - this does not, at the cost of some fifty to two
/// hundred points.
[[nodiscard]] Resonance peak_sweep(const steady::Joint& joint, double omega_from, double omega_to,
                                   const ResonanceOptions& resonance_options);

}  // namespace dovetail::paths
