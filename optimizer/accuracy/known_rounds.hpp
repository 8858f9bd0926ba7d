#pragma once

#include <vector>

#include "optimizer/accuracy/choice.hpp"

namespace dovetail::optimizer {

/// A round that has bars.
struct KnownRound {
  SettingsTried tried;
  AccuracyAnswer answer;
  Forecast alone, forecast;  ///< before and after the others were heard
};

/// Rounds whose bars do not meet contradict each other, and nothing says which bar is too small: both reach to where
/// the other begins. One that contradicts most of the others is out of line, and heard no more.
void judge(std::vector<KnownRound>& rounds);

/// By what is known of it; infinite where nothing is.
[[nodiscard]] double known_excess(const KnownRound& round);

/// The cheapest that is accurate enough; where none is, of those that are hardly less accurate than the best of them:
/// what is missed all the same is not paid for. Where no mesh resolves all that is asked of, the rest of it counts, and
/// without a rest the first.
[[nodiscard]] const KnownRound& best_of(const std::vector<KnownRound>& rounds);

/// Whether the last rounds brought nothing, each by what it says alone: together they raise each other's bars.
[[nodiscard]] bool runs_idle(const std::vector<KnownRound>& rounds);

}  // namespace dovetail::optimizer
