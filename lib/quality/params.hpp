#pragma once

namespace dovetail::quality {

/// Factors from changes under refinement to bars; where they come from stands at error_bars. Smaller ones leave true
/// errors outside, larger ones make bars that decide nothing.
struct BarParams {
  double harmonics = 2;            ///< contact without mass: changes fall like 1/H or faster
  double harmonics_with_mass = 4;  ///< impacts make them fall more slowly
  double samples = 3;
  double penalty = 0.25;  ///< of the change by a factor of four in eps
};
static_assert(BarParams{}.harmonics < BarParams{}.harmonics_with_mass, "impacts converge more slowly");

/// The choice of harmonics and samples.
struct AutomaticParams {
  double floor = 1e-6;         ///< of the largest amplitude: smaller ones are known to this
  double energy_floor = 1e-3;  ///< of the energy put in: friction that takes less is known to this
  double share = 0.5;          ///< of a bar, from which on its source is refined
  /// Where it begins: a harmonic of friction beside the excitation's, and so many instants that the bar of samples
  /// rarely asks for more; fewer than eight per harmonic alias into the highest.
  int harmonics = 3, samples = 128, samples_per_harmonic = 8;
};

}  // namespace dovetail::quality
