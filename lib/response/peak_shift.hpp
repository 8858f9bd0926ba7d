#pragma once

#include <memory>

#include "response/resonance.hpp"

namespace dovetail::response {

/// How far a resonance moves when its settings change; infinite where that is unknown.
struct PeakShift {
  Status status = Status::iteration_limit;  ///< of the states it took; no_bracket: no maximum near at the new settings
  double omega = kInfinity;                 ///< |change| of the resonance frequency, rad/s
  double amplitude = kInfinity;             ///< |change| of the peak amplitude
  SteadyState state;                        ///< at the new settings and the old frequency
  int jacobians = 0;
};

/// From the resonance `at` of an output to settings `other`: the vertex of the parabola through the amplitudes of three
/// states a tenth of the peak's half-width apart, again about the vertex while that is far off. Amplitudes alone
/// serve, since their slope chatters as contact changes between samples. Three to twelve states, each started close.
[[nodiscard]] PeakShift peak_shift(const std::shared_ptr<const CondensedModel>& model, const Resonance& at,
                                   Eigen::Index output, const ContactCondition& condition, const SteadyOptions& other);

}  // namespace dovetail::response
