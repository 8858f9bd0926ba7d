#pragma once

#include <memory>

#include "quality/error_bars.hpp"

namespace dovetail::quality {

/// What error bars compare a state with: the same state at finer settings, each changed in one respect.
struct Refinements {
  steady::State harmonics;  ///< 2H+1 harmonics; and twice the samples while they are not more than twice these
  steady::State samples;    ///< 2N samples
  steady::State softer;     ///< half the pseudo-penalty
  steady::State stiffer;    ///< twice the pseudo-penalty
  int jacobians = 0;
};

/// `samples`, doubled while the highest harmonics of their series alias each other: more than four for each harmonic.
[[nodiscard]] int samples_for(int harmonics, int samples);

/// Settings of the first two refinements.
[[nodiscard]] steady::Options more_harmonics(steady::Options options);
[[nodiscard]] steady::Options more_samples(steady::Options options);

/// Factor on changes with eps, >= 1: twice the octaves between the eps of the state and the local contact stiffness.
[[nodiscard]] double penalty_weight(const dynamics::CondensedModel& model, const steady::State& state);

/// Solves for all four, from a converged state.
[[nodiscard]] Refinements refine(const steady::Joint& joint, const steady::State& state);

/// Bars of quantities from their changes (absolute) under the four refinements with the factors of error_bars, which
/// differ when contact carries mass.
struct TruncationChanges {
  Quantities harmonics, samples, softer, stiffer;
};
[[nodiscard]] ErrorBars bars_from(const Quantities& value, const TruncationChanges& changes, double tolerance,
                                  bool massless);

/// The same from the refined states.
[[nodiscard]] ErrorBars bars_from(const steady::Joint& joint, const steady::State& state,
                                  const Refinements& refinements);

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

}  // namespace dovetail::quality
