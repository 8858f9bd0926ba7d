#include "tests/verification/optimizer/random_search.hpp"

#include <cstdint>
#include <utility>

#include "optimizer/search/random_stream.hpp"

namespace dovetail::optimizer {

std::optional<Candidate> best_random(const Problem& problem, const Evaluator& evaluator, int designs,
                                     const OptimizerOptions& options) {
  RandomStream random(static_cast<std::uint64_t>(options.seed));
  std::optional<Candidate> best;
  int feasible = 0;
  for (int drawn = 0; feasible < designs; ++drawn) {
    if (drawn == 20 * designs) return {};
    std::vector<double> unit;
    for (std::size_t i = 0; i < problem.space.size(); ++i) unit.push_back(random.uniform());
    Candidate candidate{.x = problem.space.from_unit(unit), .evaluation = {}, .judgement = {}, .phase = "random"};
    candidate.evaluation = evaluator(candidate.x);
    candidate.judgement = judge(problem, candidate.evaluation, options.constraint_tolerance);
    if (!candidate.judgement.feasible) continue;
    ++feasible;
    if (!best || candidate.judgement.objective < best->judgement.objective) best = std::move(candidate);
  }
  return best;
}

}  // namespace dovetail::optimizer
