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

/// The maximum within options.search_range of omega_start, rad/s: the zero of dA/dw, bracketed by steps in frequency;
/// where these fall off a curve that leans over, climb() from the highest point found. No sweep.
[[nodiscard]] Resonance search_peak(const steady::Joint& joint, double omega_start, const ResonanceOptions& options,
                                    const Eigen::MatrixXd& guess);

}  // namespace dovetail::paths
