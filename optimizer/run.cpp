#include "optimizer/run.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>

#include "optimizer/ipopt_search.hpp"
#include "optimizer/nlopt_search.hpp"
#include "optimizer/random_stream.hpp"
#include "optimizer/session.hpp"
#include "optimizer/space_filling.hpp"

namespace dovetail::optimizer {

namespace {

void check(const Problem& problem, const OptimizerOptions& options) {
  std::vector<Violation> found = violations(options, "optimizer");
  try {
    optimizer::check(problem);
  } catch (const InputError& error) {
    found.insert(found.end(), error.violations().begin(), error.violations().end());
  }
  if (!found.empty()) throw InputError(std::move(found));
}

SearchOutcome search_once(EvaluationSession& session, double step, int run) {
  const OptimizerOptions& options = session.options();
  SearchFunctions functions(session, options.algorithm);
  const std::vector<double> start = session.unit(functions.reference());
  ++session.statistics().local_runs;
  try {
    if (options.algorithm == "ipopt") return ipopt_search(functions, start);
    const auto seed = static_cast<std::uint64_t>(options.seed) + static_cast<std::uint64_t>(run) * 1000003U;
    return nlopt_search(options.algorithm, functions, start, step, seed);
  } catch (const StopSearch& stop) {
    if (stop.reason != Status::stalled) throw;
    return {.status = Status::stalled, .message = options.algorithm + ": asks only for candidates it already knows"};
  }
}

/// The algorithm, then restarts from the best with smaller steps until one brings nothing.
SearchOutcome search(EvaluationSession& session) {
  const OptimizerOptions& options = session.options();
  double step = options.initial_step;
  SearchOutcome outcome = search_once(session, step, 0);
  if (is_global(options.algorithm)) return outcome;
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

std::string describe(Status status, const std::string& message) {
  if (status == Status::iteration_limit && message.empty()) return "the budget of evaluations is used up";
  if (status == Status::interrupted) return "interrupted; everything finished is kept";
  return message;
}

OptimizationResult result_of(EvaluationSession& session, Status status, const std::string& message) {
  OptimizationResult result;
  result.status = status;
  result.message = describe(status, message);
  result.best = session.best();
  if (!result.best) result.least_broken = session.least_broken();
  session.statistics().unused_records = session.unused_records();
  result.statistics = session.statistics();
  result.evaluations.assign(session.candidates().begin(), session.candidates().end());
  if (!result.best) result.message += "; no candidate meets every constraint";
  return result;
}

void scan(EvaluationSession& session) {
  const OptimizerOptions& options = session.options();
  int count = options.scan_evaluations;
  // As an algorithm of its own the scan takes the whole budget unless told otherwise.
  if (options.algorithm == "scan" && count == 0) count = options.max_evaluations - 1;
  if (count == 0) return;
  static_cast<void>(
      session.evaluate_all(latin_hypercube(static_cast<std::size_t>(count), session.problem().space.size(),
                                           static_cast<std::uint64_t>(options.seed)),
                           "scan"));
}

}  // namespace

OptimizationResult run_optimization(const Problem& problem, const Evaluator& evaluator, const OptimizerOptions& options,
                                    const RunHooks& hooks) {
  check(problem, options);
  EvaluationSession session(problem, evaluator, options, hooks);
  try {
    session.evaluate_start();
    scan(session);
    if (options.algorithm == "scan") return result_of(session, Status::converged, "scan: complete");
    const SearchOutcome outcome = search(session);
    return result_of(session, outcome.status, outcome.message);
  } catch (const StopSearch& stop) {
    return result_of(session, stop.reason, {});
  }
}

OptimizationResult random_search(const Problem& problem, const Evaluator& evaluator, int feasible_designs,
                                 const OptimizerOptions& options, const RunHooks& hooks) {
  constexpr int kDrawsPerDesign = 20;
  OptimizerOptions budget = options;
  budget.max_evaluations = kDrawsPerDesign * std::max(1, feasible_designs);
  check(problem, budget);
  EvaluationSession session(problem, evaluator, budget, hooks);
  RandomStream random(static_cast<std::uint64_t>(options.seed));
  int feasible = 0;
  try {
    while (feasible < feasible_designs) {
      // As many as are missing for sure, so that the number of threads does not change what is drawn.
      std::vector<std::vector<double>> points(static_cast<std::size_t>(feasible_designs - feasible));
      for (std::vector<double>& point : points)
        for (std::size_t i = 0; i < problem.space.size(); ++i) point.push_back(random.uniform());
      for (const std::size_t index : session.evaluate_all(points, "random"))
        feasible += session[index].judgement.feasible ? 1 : 0;
    }
    return result_of(session, Status::converged, "random search: complete");
  } catch (const StopSearch& stop) {
    const std::string drawn = std::to_string(session.candidates().size()) + " random candidates hold only " +
                              std::to_string(feasible) + " feasible ones";
    return result_of(session, stop.reason, drawn);
  }
}

}  // namespace dovetail::optimizer
