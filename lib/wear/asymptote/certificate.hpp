#pragma once

#include "steady/state.hpp"

namespace dovetail::wear {

/// How nearly nothing wears any more at given depths, with contact everywhere.
struct Certificate {
  Status status = Status::converged;
  double remaining = 0.0;  ///< largest rate over the largest unworn one; NaN when the state could not be solved
  int harmonics = 0, samples = 0;
  int jacobians = 0;
};

/// 2H+1 harmonics and 2N samples, more where the harmonics need them.
[[nodiscard]] steady::Options finer_settings(const steady::Options& steady);

/// Solves the worn `joint`, at settings that may differ from those of `from`: what rests at H harmonics and N samples
/// may slip at more.
/// - `fastest`: largest unworn rate, m per cycle
/// - `from`: regular steady state near it, at the frequency wanted
///
/// Cost: one steady state, warm-started.
[[nodiscard]] Certificate certificate(steady::Joint joint, double fastest, const steady::State& from);

}  // namespace dovetail::wear
