#pragma once

#include "paths/resonance.hpp"
#include "wear/asymptote/rest.hpp"

namespace dovetail::wear {

/// Wear while the excitation tracks the resonance: the asymptote at `omega` held, then on from there at the resonance
/// of the worn joint, until that stays to 1e-7; the verdict is not_converged when that one is lost. Each asymptote
/// starts from the depths of the one before. A history retunes all the time; this one only whenever wear has come to
/// rest.
///
/// @param unworn  steady state of `joint` at omega, or null
/// Cost: three to ten asymptotes and resonances. Throws InputError as asymptote() does.
[[nodiscard]] Rest followed_asymptote(const steady::Joint& joint, double omega, const AsymptoteOptions& options = {},
                                      const paths::ResonanceOptions& resonance = {},
                                      const steady::State* unworn = nullptr, const Watcher& watcher = {});

}  // namespace dovetail::wear
