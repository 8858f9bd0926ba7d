#pragma once

#include <memory>

#include "response/steady_state.hpp"

namespace dovetail::response {

struct ResonanceOptions {
  int output = 0;                     ///< monitored output, [0, n_out)
  double frequency_tolerance = 1e-7;  ///< of omega, relative; the stationarity chatters at 1e-8. > 0
  double search_range = 0.2;          ///< omega may move by this fraction from its start, (0, 1)
  int max_solves = 80;                ///< steady states, >= 1
};

struct Resonance {
  Status status = Status::no_bracket;
  double omega = 0;      ///< rad/s, where the amplitude is largest
  double amplitude = 0;  ///< half peak-to-peak of the output
  double slope = 0;      ///< dA/dw at omega
  int solves = 0;        ///< steady states computed
  int jacobians = 0;     ///< Jacobians of all of them
  SteadyState state;     ///< at omega, with linearisation
};

/// The maximum of the amplitude of one output on the response curve near `omega_start` (rad/s; the glued natural
/// frequency is a good start). The slope dA/dw is exact (dU/dw = -J^-1 df/dw); its zero is bracketed, then found by
/// a safeguarded secant. `guess` may be the response at omega_start.
[[nodiscard]] Resonance resonance(const std::shared_ptr<const CondensedModel>& model, double omega_start,
                                  const ContactCondition& condition, const SteadyOptions& options,
                                  const ResonanceOptions& resonance_options = {}, const Eigen::MatrixXd& guess = {});

/// Amplitude of one output and its total derivative with respect to omega at a converged state.
struct AmplitudeSlope {
  double amplitude = 0, slope = 0;
};
[[nodiscard]] AmplitudeSlope amplitude_slope(const SteadyState& state, Eigen::Index output);

}  // namespace dovetail::response

namespace dovetail {
template <>
std::span<const Field<response::ResonanceOptions>> option_table<response::ResonanceOptions>();
}
