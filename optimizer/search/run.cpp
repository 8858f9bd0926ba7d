#include "optimizer/search/run.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "core/options.hpp"
#include "optimizer/search/corrected_search.hpp"
#include "optimizer/search/finer_limits.hpp"
#include "optimizer/search/one_search.hpp"
#include "optimizer/search/session.hpp"
#include "optimizer/search/space_filling.hpp"

namespace dovetail::optimizer {

namespace {

void check(const Problem& problem, const OptimizerOptions& options) {
  std::vector<Violation> found = violations(options, "optimizer");
  for (Violation& wrong : contradictions(options, problem.front)) found.push_back(std::move(wrong));
  try {
    optimizer::check(problem);
  } catch (const InputError& error) {
    found.insert(found.end(), error.violations().begin(), error.violations().end());
  }
  if (!found.empty()) throw InputError(std::move(found));
}

/// How the best of several designs with the same objective was chosen; empty where it is the only one.
std::string tie_words(const EvaluationSession& session) {
  if (!session.best()) return {};
  const Judgement& best = session[*session.best()].judgement;
  const auto tied = std::ranges::count_if(session.candidates(), [&](const Candidate& candidate) {
    return candidate.judgement.feasible && candidate.judgement.objective == best.objective;
  });
  if (tied < 2) return {};
  std::string text = "; " + std::to_string(tied) + " designs have the same objective: the best of them ";
  if (best.slip_margin < 0) return text + "is the one with the smallest amplitude";
  if (best.slip_margin < 5e-4) return text + "is the one farthest from slip, with next to none of its friction left";
  return text + "is the one farthest from slip, with " + shortest(std::round(1000 * best.slip_margin) / 10) +
         " % of its friction left";
}

OptimizationResult result_of(EvaluationSession& session, const SearchOutcome& outcome) {
  OptimizationResult result;
  result.status = outcome.status;
  result.message = words_of(outcome);
  result.best = session.best();
  if (session.problem().front && result.best) {
    result.front = front_in(session);
    result.best = result.front->compromise;
    if (result.front->moves)
      result.message +=
          "; without a feasible scan the reference is the worst of start and front, which moves with the search: give "
          "`reference` to compare runs by their hypervolume";
  }
  if (!result.best) result.least_broken = session.least_broken();
  session.statistics().unused_records = session.unused_records();
  result.statistics = session.statistics();
  result.evaluations.assign(session.candidates().begin(), session.candidates().end());
  if (!result.best) {
    const bool some = std::ranges::any_of(
        result.evaluations, [](const Candidate& c) { return c.evaluation.converged() || c.evaluation.infeasible(); });
    result.message += some ? "; no candidate meets every constraint" : "; no candidate could be computed";
  }
  if (!result.front) result.message += tie_words(session);
  return result;
}

void scan(EvaluationSession& session, const std::optional<Part>& part) {
  const OptimizerOptions& options = session.options();
  const std::size_t variables = session.problem().space.size();
  const auto count = static_cast<std::size_t>(scan_size(options, variables));
  if (count == 0) return;
  std::vector<std::vector<double>> points = latin_hypercube(count, variables, static_cast<std::uint64_t>(options.seed));
  if (part) {
    std::vector<std::vector<double>> own;
    for (std::size_t i = static_cast<std::size_t>(part->number) - 1; i < count; i += static_cast<std::size_t>(part->of))
      own.push_back(points[i]);
    points = std::move(own);
  }
  static_cast<void>(session.evaluate_all(points, kScanPhase));
}

}  // namespace

OptimizationResult run_optimization(const Problem& problem, const Evaluator& evaluator, const OptimizerOptions& options,
                                    const RunHooks& hooks) {
  check(problem, options);
  EvaluationSession session(problem, evaluator, options, hooks);
  FinerLimits finer(session, hooks);
  SearchOutcome outcome;
  bool stopped = false;
  try {
    session.evaluate_start();
    static_cast<void>(within_budget([&] {
      scan(session, hooks.part);
      return SearchOutcome{};
    }));
    if (hooks.part)
      outcome = {.status = Status::converged, .message = "a part of the scan: complete"};
    else
      outcome = problem.front ? corrected_front(session, finer) : corrected_search(session, finer);
  } catch (const StopSearch& stop) {
    outcome = {.status = stop.reason, .message = {}};
    stopped = true;
    session.focus({});
  }
  OptimizationResult result = result_of(session, outcome);
  if (stopped) {
    const auto looks =
        std::ranges::count_if(finer.checks(), [&](const FinerCheck& check) { return check.candidate == result.best; });
    if (finer.active() && result.best && looks < options.finer_meshes)
      result.message += "; how the best design so far keeps its limits on finer meshes is not known";
  }
  result.finer = finer.checks();
  return result;
}

}  // namespace dovetail::optimizer
