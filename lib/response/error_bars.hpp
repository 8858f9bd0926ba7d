#pragma once

#include <memory>

#include "response/quantities.hpp"
#include "response/resonance.hpp"

namespace dovetail::response {

struct ErrorBarOptions {
  double safety = 1;  ///< multiplies all bars, > 0; 1 keeps about 95 % of true errors inside
};

/// Error bars of the truncation: how far the results of a steady state may be from those of infinitely many harmonics
/// and samples, and of how much the choice of the pseudo-penalty eps decides. Absolute, in the unit of the value. An
/// entry is infinite where a refined state did not converge: unknown, never zero.
struct ErrorBars {
  /// converged: all refined states did; otherwise the status of the first that did not, and infinite bars.
  Status status = Status::iteration_limit;
  Quantities value;      ///< of the state itself
  Quantities harmonics;  ///< bar of the truncation to H harmonics
  Quantities samples;    ///< bar of the N samples of the march
  Quantities penalty;    ///< bar of eps
  Quantities total;      ///< the bar: what to report
  Quantities refined;    ///< values at the finest settings computed, more accurate than `value` as a rule
  int jacobians = 0;     ///< of all refined states
};

/// Bars of a converged `state` computed with `options` under `condition`, by states at refined settings started from
/// it: 2H+1 harmonics, 2N samples, eps halved and doubled. A state that is not converged, or a refined one that is not,
/// gives infinite bars with its status. Cost: about as many Jacobians as three states of 2H+1 harmonics.
[[nodiscard]] ErrorBars error_bars(const std::shared_ptr<const CondensedModel>& model, const SteadyState& state,
                                   const ContactCondition& condition, const SteadyOptions& options,
                                   const ErrorBarOptions& bar_options = {});

/// Bars of a resonance: those of the state at its peak at fixed frequency, and how far the peak moves.
struct ResonanceBars {
  Status status = Status::iteration_limit;
  double omega = 0;      ///< bar of the resonance frequency, rad/s
  double amplitude = 0;  ///< bar of the peak amplitude
  ErrorBars state;       ///< at the resonance frequency found
};
[[nodiscard]] ResonanceBars error_bars(const std::shared_ptr<const CondensedModel>& model, const Resonance& resonance,
                                       const ContactCondition& condition, const SteadyOptions& options,
                                       const ResonanceOptions& resonance_options,
                                       const ErrorBarOptions& bar_options = {});

}  // namespace dovetail::response

namespace dovetail {
template <>
std::span<const Field<response::ErrorBarOptions>> option_table<response::ErrorBarOptions>();
}
