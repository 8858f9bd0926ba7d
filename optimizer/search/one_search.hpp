#pragma once

#include "optimizer/search/search_outcome.hpp"
#include "optimizer/search/session.hpp"

namespace dovetail::optimizer {

/// The algorithm of the options, once, from the best candidate that is known. Throws StopSearch when the budget is used
/// up and when it was asked to.
/// - `step`: the first one, fraction of the ranges
/// - `run`: which of several, for another seed
[[nodiscard]] SearchOutcome search_once(EvaluationSession& session, double step, int run);

/// The algorithm, then restarts from the best with smaller steps until one brings nothing. Throws as search_once().
[[nodiscard]] SearchOutcome search_with_restarts(EvaluationSession& session);

/// The search, ended by its budget or by itself.
template <class Search>
SearchOutcome within_budget(Search&& search) {
  try {
    return search();
  } catch (const StopSearch& stop) {
    if (stop.reason != Status::iteration_limit) throw;
    return {.status = stop.reason, .message = {}};
  }
}

}  // namespace dovetail::optimizer
