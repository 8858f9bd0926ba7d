#pragma once

#include <Eigen/Core>
#include <memory>

#include "response/solve.hpp"
#include "response/steady_state.hpp"

namespace dovetail::response {

/// What is tried for a steady state that neither Newton from closed contact nor the pseudo-penalty cascade found. Four
/// ways to a better start, cheapest first, each from solutions of neighbouring problems; all end with the problem as it
/// was asked, so a rescue changes whether there is an answer and not what counts as one:
///   open      the linear response without contact,
///   harmonics the series grows from one harmonic to H,
///   penalty   eps grows from a thousandth to its value,
///   frequency omega falls from three times its value, above the resonances, with steps that shrink when one fails.
/// Spends at most `max_iterations` Jacobians, more by one attempt. Without success: iteration_limit, no displacement
/// and an infinite residual.
[[nodiscard]] Attempt rescue(const std::shared_ptr<const CondensedModel>& model,
                             const std::shared_ptr<const HarmonicSystem>& system, const ContactCondition& condition,
                             const SteadyOptions& options, int max_iterations);

}  // namespace dovetail::response
