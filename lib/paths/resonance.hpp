#pragma once

#include <memory>

#include "paths/steady_state.hpp"

namespace dovetail::paths {

struct ResonanceOptions {
  int output = 0;                     ///< monitored output, [0, n_out)
  double frequency_tolerance = 1e-7;  ///< of omega, relative; the stationarity chatters at 1e-8. > 0
  double search_range = 0.2;          ///< the search next to the start moves omega by at most this fraction, (0, 1)
  double sweep_range = 0.9;           ///< when it fails, the branch is followed within this fraction, [0, 1); 0: no
  int max_solves = 80;                ///< steady states of the search next to the start, >= 1
  int max_sweep_jacobians = 5000;     ///< of following the branch, >= 1
  /// The guess is next to the peak: no way to it is looked for with fewer harmonics.
  bool begins_near = false;
};

struct Resonance {
  Status status = Status::no_bracket;
  bool swept = false;    ///< found by following the branch, not by the search next to the start
  double omega = 0;      ///< rad/s, where the amplitude is largest
  double amplitude = 0;  ///< half peak-to-peak of the output
  double slope = 0;      ///< dA/dw at omega
  /// Of the highest point that the branch was followed through, when it is higher than the maximum, of which none was
  /// found beside it; else 0.
  double unresolved = 0;
  double ends = 0;      ///< the higher amplitude at the ends of the range through which the branch was followed
  int solves = 0;       ///< steady states computed
  int jacobians = 0;    ///< Jacobians of all of them
  steady::State state;  ///< at omega, with its tangent
};

/// The maximum of the amplitude of one output on the response curve near `omega_start` (rad/s; the glued natural
/// frequency is a good start). The slope dA/dw is exact (dU/dw = -J^-1 df/dw); its zero is bracketed, then found by
/// a safeguarded secant, all within `search_range` of the start. Where steps in frequency fall off a curve that leans
/// over, Newton on (U, omega) climbs to the maximum from the highest point found. `guess` may be the response at
/// omega_start.
///
/// When that ends without a maximum - it lies further away, the curve jumps between branches, a solve fails - the
/// branch is followed between start (1 - sweep_range) and start (1 + search_range), through its turning points, and its
/// highest maximum taken: contact that slips or opens is softer than the glued one, so it is below that the peak can be
/// far. This costs some hundred solves; max_sweep_jacobians limits it. With a sweep_range of 0 a peak that cannot be
/// followed is said to be none: for peaks tracked from one that is known, where another is no answer.
[[nodiscard]] Resonance resonance(const steady::Joint& joint, double omega_start,
                                  const ResonanceOptions& resonance_options = {}, const Eigen::MatrixXd& guess = {});

}  // namespace dovetail::paths

namespace dovetail {
template <>
std::span<const Field<paths::ResonanceOptions>> option_table<paths::ResonanceOptions>();
}
