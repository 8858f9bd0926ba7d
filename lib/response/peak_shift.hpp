#pragma once

#include <memory>

#include "response/resonance.hpp"

namespace dovetail::response {

/// How far a resonance moves when its settings change; infinite where that is unknown.
struct PeakShift {
  Status status = Status::iteration_limit;  ///< of the states it took; no_bracket: no maximum at the new settings
  double omega = kInfinity;                 ///< |change| of the resonance frequency, rad/s
  double amplitude = kInfinity;             ///< |change| of the peak amplitude
  SteadyState state;                        ///< at the new settings and the old frequency
  int jacobians = 0;
};

/// From the resonance `at` to settings `other`, by one Newton step on dA/dw with its slope from a difference: two
/// states, started from that of the resonance.
[[nodiscard]] PeakShift peak_shift(const std::shared_ptr<const CondensedModel>& model, const Resonance& at,
                                   Eigen::Index output, const ContactCondition& condition, const SteadyOptions& other);

}  // namespace dovetail::response
