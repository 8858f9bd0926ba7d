#include "optimizer/search/run.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "core/options.hpp"
#include "optimizer/search/finer_limits.hpp"
#include "optimizer/search/front_search.hpp"
#include "optimizer/search/ipopt_search.hpp"
#include "optimizer/search/nlopt_search.hpp"
#include "optimizer/search/pagmo_search.hpp"
#include "optimizer/search/params.hpp"
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

/// The algorithm, then restarts from the best with smaller steps until one brings nothing.
SearchOutcome search(EvaluationSession& session) {
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

Front front_in(const EvaluationSession& session) {
  const std::vector<Candidate> all(session.candidates().begin(), session.candidates().end());
  return front_of(session.problem(), all);
}

/// The candidate to look at on finer meshes: the best one (of a front its compromise), or, where what was seen of
/// others refuses everyone, the one it refuses by the least.
std::optional<std::size_t> next_to_look_at(const EvaluationSession& session) {
  if (!session.best()) return session.refused_by_shifts();
  return session.problem().front ? front_in(session).compromise : *session.best();
}

/// After a search whose best designs broke limits on finer meshes: the best known one, unlike them, that does not.
void settle_for_another(EvaluationSession& session, FinerLimits& finer, const CorrectionParams& params) {
  std::vector<std::size_t> broken;
  for (const FinerCheck& check : finer.checks())
    if (!check.held && session[check.candidate].evaluation.feasible) broken.push_back(check.candidate);
  const auto beside = [&](std::size_t i, std::size_t j) {
    return std::ranges::equal(session.unit(i), session.unit(j),
                              [&](double a, double b) { return std::abs(a - b) <= params.apart; });
  };
  int look = 0;
  for (auto next = next_to_look_at(session); next && !session.accepted(*next); next = next_to_look_at(session)) {
    const bool looked_enough = look == params.looks;
    if (looked_enough && !session.best()) return;
    if (looked_enough || std::ranges::any_of(broken, [&](std::size_t i) { return beside(*next, i); })) {
      session.reject(*next);
      continue;
    }
    ++look;
    if (!finer.holds(*next)) broken.push_back(*next);
  }
}

std::string describe(Status status, const std::string& message) {
  if (status == Status::iteration_limit && message.empty()) return kBudgetUsedUp;
  if (status == Status::interrupted) return "interrupted; everything finished is kept";
  return message;
}

/// Why designs that keep the limits of the search's mesh were refused, by a look or by what looks change in limits.
std::string refused_words(const FinerLimits& finer) {
  const auto unknown = std::ranges::count_if(
      finer.checks(), [](const FinerCheck& check) { return !check.held && !check.evaluation.converged(); });
  const auto refused = std::ranges::count_if(finer.checks(), [](const FinerCheck& check) { return !check.held; });
  if (unknown == 0) return "limits kept on the search's mesh break on finer ones";
  return unknown == refused ? "of limits kept on the search's mesh finer ones have no answer"
                            : "limits kept on the search's mesh break on finer ones, or have no answer there";
}

/// Some keep all limits on the mesh of the search, and none does on finer ones.
bool all_refused(const EvaluationSession& session) {
  return !session.best() && std::ranges::any_of(session.candidates(), [](const Candidate& candidate) {
    return candidate.evaluation.feasible;
  });
}

/// Evaluations from now on leave this part of `of`.
void leave(EvaluationSession& session, double part, std::size_t of) {
  const auto left = static_cast<std::size_t>(part * static_cast<double>(of));
  session.limit(
      std::max(session.candidates().size(), static_cast<std::size_t>(session.options().max_evaluations) - left));
}

/// By what is seen where the search begins: at the best design, or the one that breaks its limits by the least. Whether
/// that says anything.
bool correct_at_start(const EvaluationSession& session, FinerLimits& finer) {
  return finer.correct(session.best().value_or(session.least_broken().value_or(0)));
}

/// The search with its limits corrected by what finer meshes say, at its start and where it ends. Its best candidate
/// keeps its limits on them, or there is none.
SearchOutcome corrected_search(EvaluationSession& session, FinerLimits& finer) {
  const OptimizerOptions& options = session.options();
  constexpr CorrectionParams kParams;
  const auto all = static_cast<std::size_t>(options.max_evaluations);
  const bool only_scan = options.algorithm == Algorithm::scan;
  bool corrected = !finer.active() || correct_at_start(session, finer);
  if (finer.active()) leave(session, corrected ? kParams.reserve : kParams.uncorrected, all);
  SearchOutcome outcome = only_scan ? SearchOutcome{.status = Status::converged, .message = "scan: complete"}
                                    : within_budget([&] { return search(session); });
  double step = kParams.step * options.initial_step;
  std::optional<std::size_t> held;
  for (int look = 0; finer.active(); ++look) {
    const std::optional<std::size_t> next = next_to_look_at(session);
    const std::size_t known = session.candidates().size(), left = all - known;
    const bool refused = !session.best(), unfinished = outcome.status == Status::iteration_limit && left > 0;
    if (!next && (!unfinished || only_scan)) break;
    if (next && finer.holds(*next) && !refused) {
      if (unfinished && next == held)
        outcome.message = "going on from the best design brought nothing better that keeps its limits; " +
                          std::to_string(left) + " evaluations of the budget are left";
      if (!unfinished || next == held) return outcome;
      held = next;
    }
    if (look + 1 >= kParams.looks || session.time_over()) {
      settle_for_another(session, finer, kParams);
      break;
    }
    if (left == 0 || only_scan) continue;
    // A search that was led by what others change there, which refused everyone, begins anew, and one that was cut
    // short before a first look which finds nothing to correct goes on. Without any to look at what was kept for looks
    // serves to find one.
    const bool cut_short = !std::exchange(corrected, true) && held;
    if (refused || cut_short) {
      leave(session, next ? kParams.reserve : 0, left);
      outcome = within_budget([&] { return search_once(session, options.initial_step, 0); });
      continue;
    }
    session.limit(known + (left + 1) / 2);
    step = std::max(step, 2 * stopping_step(options));
    if (const SearchOutcome again = within_budget([&] { return search_once(session, step, look + 1); });
        again.status == Status::converged)
      outcome = again;
    step /= 2;
  }
  if (finer.active() && all_refused(session))
    outcome.message = describe(outcome.status, outcome.message) + "; " + refused_words(finer);
  return outcome;
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

/// Points of a front, of which the compromise keeps its limits on finer meshes.
SearchOutcome front_search(EvaluationSession& session, FinerLimits& finer) {
  const OptimizerOptions& options = session.options();
  constexpr CorrectionParams kParams;
  const auto points = [&] {
    SearchOutcome found{.status = Status::converged, .message = "scan: complete"};
    if (options.algorithm == Algorithm::nsga2)
      found = within_budget([&] { return search_once(session, options.initial_step, 0); });
    else if (options.algorithm != Algorithm::scan)
      found = within_budget(
          [&] { return epsilon_constraint(session, [&] { return within_budget([&] { return search(session); }); }); });
    session.focus({});
    return found;
  };
  const auto all = static_cast<std::size_t>(options.max_evaluations);
  // Without a design to correct limits by, or where it refuses everyone, the search may have to be done again.
  const bool corrected = !finer.active() || (correct_at_start(session, finer) && !session.refused_by_shifts());
  if (!corrected) leave(session, kParams.uncorrected, all);
  SearchOutcome outcome = points();
  leave(session, 0, 0);
  bool kept = !corrected;
  for (int look = 0; finer.active() && look < kParams.looks; ++look) {
    const std::optional<std::size_t> next = next_to_look_at(session);
    const bool refused = !session.best();
    kept = kept && outcome.status == Status::iteration_limit && session.candidates().size() < all;
    if (!next && !kept) break;
    if (next && finer.holds(*next) && !refused && !kept) return outcome;
    if (kept || (refused && session.best())) outcome = points();
    kept = false;
  }
  if (!finer.active() || (session.best() && session.accepted(front_in(session).compromise))) return outcome;
  if (session.best())
    outcome.message = describe(outcome.status, outcome.message) + "; of points that looked like a compromise " +
                      refused_words(finer) + ", and the one there is now was not looked at";
  else if (all_refused(session))
    outcome.message = describe(outcome.status, outcome.message) + "; " + refused_words(finer);
  return outcome;
}

OptimizationResult result_of(EvaluationSession& session, Status status, const std::string& message) {
  OptimizationResult result;
  result.status = status;
  result.message = describe(status, message);
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
      outcome = problem.front ? front_search(session, finer) : corrected_search(session, finer);
  } catch (const StopSearch& stop) {
    outcome = {.status = stop.reason, .message = {}};
    stopped = true;
    session.focus({});
  }
  OptimizationResult result = result_of(session, outcome.status, outcome.message);
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
