#pragma once

#include <Eigen/Core>
#include <memory>

#include "response/solve.hpp"
#include "response/steady_state.hpp"

namespace dovetail::response {

/// A state found by a rescue.
struct Rescued {
  Attempt attempt;
  double penalty_ratio = 1;  ///< of the eps it was found with
};

/// What is tried for a steady state that neither Newton from closed contact nor the pseudo-penalty cascade found: ways
/// to a better start, cheapest first, each from solutions of neighbouring problems. All end with the problem as it was
/// asked, the last at worst with another eps, so a rescue changes whether there is an answer and not what counts as
/// one:
///   open      the linear response without contact,
///   harmonics the series grows from one harmonic to H,
///   penalty   eps grows from a thousandth to its value,
///   frequency omega falls from three times its value, above the resonances, with steps that shrink when one fails,
///   damping   dashpots across the contact fade away; where steps fail, along the curve of solutions through its turns.
/// Spends at most `max_iterations` Jacobians, more by one attempt for each way. Without success: iteration_limit, no
/// displacement and an infinite residual.
[[nodiscard]] Rescued rescue(const std::shared_ptr<const CondensedModel>& model,
                             const std::shared_ptr<const HarmonicSystem>& system, const ContactCondition& condition,
                             const SteadyOptions& options, int max_iterations);

}  // namespace dovetail::response
