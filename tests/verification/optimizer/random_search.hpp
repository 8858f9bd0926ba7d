#pragma once

#include <optional>
#include <vector>

#include "optimizer/search/run.hpp"

namespace dovetail::optimizer {

/// The yardstick of a search: the best of `designs` feasible candidates drawn uniformly, nothing when 20 times as many
/// draws hold fewer. options: seed, constraint_tolerance.
std::optional<Candidate> best_random(const Problem& problem, const Evaluator& evaluator, int designs,
                                     const OptimizerOptions& options);

}  // namespace dovetail::optimizer
