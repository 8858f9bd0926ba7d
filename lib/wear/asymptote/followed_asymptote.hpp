#pragma once

#include <optional>
#include <vector>

#include "paths/resonance.hpp"
#include "wear/asymptote/asymptote.hpp"

namespace dovetail::wear {

/// An asymptote and the frequencies it was followed over.
struct FollowedAsymptote {
  Asymptote asymptote;
  std::optional<Asymptote> held = {};  ///< where the resonance is followed: the first one, at the frequency given
  std::vector<double> omegas = {};     ///< rad/s, of the successive asymptotes; the last is where wear came to rest
  int solves = 0, jacobians = 0;       ///< over everything
};

/// Wear while the excitation tracks the resonance: the asymptote at `omega` held, then on from there at the resonance
/// of the worn joint, until that stays to 1e-7; the verdict is not_converged when that one is lost. Each asymptote
/// starts from the depths of the one before. A history retunes all the time; this one only whenever wear has come to
/// rest.
/// - `unworn`: steady state of `joint` at omega, or null
///
/// Cost: three to ten asymptotes and resonances. Throws InputError as asymptote() does.
[[nodiscard]] FollowedAsymptote followed_asymptote(const steady::Joint& joint, double omega,
                                                   const AsymptoteOptions& options = {},
                                                   const paths::ResonanceOptions& resonance = {},
                                                   const steady::State* unworn = nullptr, const Watcher& watcher = {});

}  // namespace dovetail::wear
