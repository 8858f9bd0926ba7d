#include "optimizer/search/one_search.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "optimizer/search/ipopt_search.hpp"
#include "optimizer/search/nlopt_search.hpp"
#include "optimizer/search/pagmo_search.hpp"

namespace dovetail::optimizer {

SearchOutcome search_once(EvaluationSession& session, double step, int run) {
  const OptimizerOptions& options = session.options();
  SearchFunctions functions(session, std::string(to_string(options.algorithm)));
  const std::vector<double> start = session.unit(functions.reference());
  try {
    const auto seed = static_cast<std::uint64_t>(options.seed) + static_cast<std::uint64_t>(run) * 1000003U;
    if (options.algorithm == Algorithm::ipopt) return ipopt_search(functions, start);
    if (options.algorithm == Algorithm::cmaes) return cmaes_search(functions, start, step, seed);
    if (options.algorithm == Algorithm::de) return de_search(functions, session, seed);
    if (options.algorithm == Algorithm::nsga2) return nsga2_search(session, seed);
    return nlopt_search(options.algorithm, functions, start, step, seed);
  } catch (const StopSearch& stop) {
    if (stop.reason != Status::stalled) throw;
    return {.status = Status::stalled,
            .message = std::string(to_string(options.algorithm)) + ": asks only for candidates it already knows"};
  }
}

SearchOutcome search_with_restarts(EvaluationSession& session) {
  const OptimizerOptions& options = session.options();
  double step = options.initial_step;
  SearchOutcome outcome = search_once(session, step, 0);
  if (is_global(options.algorithm) || options.algorithm == Algorithm::de) return outcome;
  for (int run = 1; run <= options.restarts; ++run) {
    step = std::max(step * options.restart_factor, 2 * stopping_step(options));
    const auto value = [&] {
      return session.best() ? session[*session.best()].judgement.objective : std::numeric_limits<double>::infinity();
    };
    const double before = value();
    outcome = search_once(session, step, run);
    if (!(value() < before - options.tolerance * std::abs(before))) break;
  }
  return outcome;
}

}  // namespace dovetail::optimizer
