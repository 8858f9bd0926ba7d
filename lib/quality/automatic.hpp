#pragma once

#include <memory>
#include <span>
#include <vector>

#include "quality/error_bars.hpp"

namespace dovetail::quality {

/// What is chosen, and how accurate it has to be. What is not chosen keeps its value of steady::Options.
struct AutomaticOptions {
  bool harmonics = true;              ///< choose H
  bool samples = true;                ///< choose N
  double amplitude_tolerance = 1e-3;  ///< bar of each output's amplitude relative to it, > 0
  double energy_tolerance = 1e-2;     ///< bar of the friction energy relative to it, > 0
  int max_harmonics = 63;             ///< >= 1
  int max_samples = 8192;             ///< > 2 max_harmonics
};

/// One steady state at settings chosen for it.
struct AutomaticState {
  /// converged: the state is and its bars are within the tolerances; iteration_limit: the state is converged, the
  /// tolerances are not reached at the largest settings allowed (`bars` says what was reached); otherwise why the
  /// state or its refinement failed.
  Status status = Status::iteration_limit;
  steady::Options options;  ///< with the harmonics and samples chosen
  steady::State state;
  ErrorBars bars;
  int solves = 0;     ///< steady states, refined ones included
  int jacobians = 0;  ///< of all of them
};

/// Chooses harmonics and samples by refinement: from H = 3 (or 1 + the largest harmonic of the force) and N = 128,
/// whichever bar contributes most is refined (H to 2H+1, N to 2N) until amplitudes and friction energy are within
/// tolerance. Where friction takes less than 1e-3 of the energy put in, that is what its tolerance is relative to; and
/// amplitudes below 1e-6 of the largest are held to that. Never throws for want of convergence.
[[nodiscard]] AutomaticState automatic_state(const steady::Joint& joint, double omega,
                                             const AutomaticOptions& automatic = {}, const Eigen::MatrixXd& guess = {});

/// True when the bars are within the tolerances of `automatic`.
[[nodiscard]] bool within(const ErrorBars& bars, const steady::State& state, const AutomaticOptions& automatic);

/// Settings for a whole range of frequencies.
struct AutomaticSettings {
  Status status = Status::iteration_limit;  ///< as of AutomaticState, the worst of all points looked at
  steady::Options options;                  ///< with the harmonics and samples chosen: use them for all points
  std::vector<std::size_t> points;          ///< indices of the frequencies looked at, in order
  std::vector<ErrorBars> bars;              ///< one for each of `points`, at the settings chosen
  int solves = 0, jacobians = 0;
};

/// One pair (H, N) for all frequencies `omega` (rad/s): curves stay comparable point by point and smooth. A coarse
/// curve at the starting settings shows the most demanding points - the largest amplitude of each output, the largest
/// friction energy, the largest e_lambda - and the settings that suit the worst of them are chosen. Other points
/// are not looked at: ask error_bars for the bar of any point of the final curve.
[[nodiscard]] AutomaticSettings automatic_settings(const steady::Joint& joint, std::span<const double> omega,
                                                   const AutomaticOptions& automatic = {});

}  // namespace dovetail::quality

namespace dovetail {
template <>
std::span<const Field<quality::AutomaticOptions>> option_table<quality::AutomaticOptions>();
}
