#pragma once

#include <functional>

#include "optimizer/search/search_outcome.hpp"

namespace dovetail::optimizer {

/// A front by the epsilon-constraint method [Haimes 1971]: the algorithm minimises every objective alone, with next to
/// no weight on the others, then the first one in this way while the others are limited between their values there - of
/// two objectives at even distances, of more at a Latin hypercube. `front_points` runs in all, in an order that is
/// spread over the front wherever it is cut short. Each begins at the best candidate known that keeps its limits, a
/// neighbour on the front. The runs have equal shares, which are doubled each time all of them are done again, until
/// every one ends by itself: no run hangs on `max_evaluations`, and with more of them a run goes on where it ended.
///
/// The session is left focused on the last run. Throws StopSearch when it was asked to and when the budget is used up.
/// - `search`: one run of the algorithm as the session is focused, ended by its budget or by itself
[[nodiscard]] SearchOutcome epsilon_constraint(EvaluationSession& session,
                                               const std::function<SearchOutcome()>& search);

}  // namespace dovetail::optimizer
