#pragma once

#include <memory>

#include "response/error_bars.hpp"

namespace dovetail::response {

/// What error bars compare a state with: the same state at finer settings, each changed in one respect.
struct Refinements {
  SteadyState harmonics;  ///< 2H+1 harmonics; and twice the samples while they are not more than twice these
  SteadyState samples;    ///< 2N samples
  SteadyState softer;     ///< half the pseudo-penalty
  SteadyState stiffer;    ///< twice the pseudo-penalty
  int jacobians = 0;
};

/// Settings of the first two refinements.
[[nodiscard]] SteadyOptions more_harmonics(SteadyOptions options);
[[nodiscard]] SteadyOptions more_samples(SteadyOptions options);

/// Factor on changes with eps, >= 1: twice the octaves between the eps of the state and the local contact stiffness.
[[nodiscard]] double penalty_weight(const CondensedModel& model, const SteadyState& state);

/// Solves for all four, from a converged state.
[[nodiscard]] Refinements refine(const std::shared_ptr<const CondensedModel>& model, const SteadyState& state,
                                 const ContactCondition& condition, const SteadyOptions& options);

/// Bars of quantities from their changes (absolute) under the four refinements with the factors of error_bars, which
/// differ when contact carries mass.
struct TruncationChanges {
  Quantities harmonics, samples, softer, stiffer;
};
[[nodiscard]] ErrorBars bars_from(const Quantities& value, const TruncationChanges& changes, double tolerance,
                                  double safety, bool massless);

/// The same from the refined states.
[[nodiscard]] ErrorBars bars_from(const CondensedModel& model, const SteadyState& state, const Refinements& refinements,
                                  const SteadyOptions& options, const ErrorBarOptions& bar_options);

/// What of a change counts, see error_bars.
struct TruncationFactors {
  double harmonics, samples, penalty;
};
[[nodiscard]] TruncationFactors truncation_factors(bool massless);

/// Bar of one number from its changes.
struct ScalarChanges {
  double harmonics = 0, samples = 0, softer = 0, stiffer = 0;
};
[[nodiscard]] double bar_from(const ScalarChanges& changes, bool massless);

}  // namespace dovetail::response
