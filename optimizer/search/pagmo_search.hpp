#pragma once

#include <cstdint>
#include <vector>

#include "optimizer/search/search_outcome.hpp"

namespace dovetail::optimizer {

/// Runs an algorithm of pagmo [Biscani, Izzo 2020] generation by generation. What a generation is going to ask is
/// foreseen with a copy of it and computed at once, where there are hooks for that; none of them asks for anything that
/// hangs on answers of its own generation.
///
/// | name | constraints | begins with |
/// |---|---|---|
/// | cmaes | exact penalty f + 10 sum max(0, c); beyond a bound the square of the distance is added | `start`,
/// deviation `step` | | de | exact penalty | the best candidates known, one generation of them | | nsga2 | whoever
/// breaks a limit is worse in every objective than who does not | the same |
///
/// de and nsga2 need as many candidates as they have in a generation, or the outcome is that of a used-up budget.
/// Throws StopSearch and what the evaluator throws. Deterministic for a seed.
[[nodiscard]] SearchOutcome cmaes_search(SearchFunctions& functions, const std::vector<double>& start, double step,
                                         std::uint64_t seed);
[[nodiscard]] SearchOutcome de_search(SearchFunctions& functions, EvaluationSession& session, std::uint64_t seed);
/// For a front; ends with the budget alone.
[[nodiscard]] SearchOutcome nsga2_search(EvaluationSession& session, std::uint64_t seed);

/// Volume between points and the reference, in which less is better; of points that do not reach it in every objective
/// nothing counts.
[[nodiscard]] double hypervolume(const std::vector<std::vector<double>>& points, const std::vector<double>& reference);

}  // namespace dovetail::optimizer
