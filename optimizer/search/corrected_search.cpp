#include "optimizer/search/corrected_search.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "optimizer/search/front_search.hpp"
#include "optimizer/search/one_search.hpp"
#include "optimizer/search/params.hpp"

namespace dovetail::optimizer {

namespace {

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

}  // namespace

Front front_in(const EvaluationSession& session) {
  const std::vector<Candidate> all(session.candidates().begin(), session.candidates().end());
  return front_of(session.problem(), all);
}

SearchOutcome corrected_search(EvaluationSession& session, FinerLimits& finer) {
  const OptimizerOptions& options = session.options();
  constexpr CorrectionParams kParams;
  const auto all = static_cast<std::size_t>(options.max_evaluations);
  const bool only_scan = options.algorithm == Algorithm::scan;
  bool corrected = !finer.active() || correct_at_start(session, finer);
  if (finer.active()) leave(session, corrected ? kParams.reserve : kParams.uncorrected, all);
  SearchOutcome outcome = only_scan ? SearchOutcome{.status = Status::converged, .message = "scan: complete"}
                                    : within_budget([&] { return search_with_restarts(session); });
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
        again.status == Status::converged && session.candidates().size() > known)
      outcome = again;  // one that could not ask for a design has not come to an end
    step /= 2;
  }
  if (finer.active() && all_refused(session)) outcome.message = words_of(outcome) + "; " + refused_words(finer);
  return outcome;
}

SearchOutcome corrected_front(EvaluationSession& session, FinerLimits& finer) {
  const OptimizerOptions& options = session.options();
  constexpr CorrectionParams kParams;
  const auto points = [&] {
    SearchOutcome found{.status = Status::converged, .message = "scan: complete"};
    if (options.algorithm == Algorithm::nsga2)
      found = within_budget([&] { return search_once(session, options.initial_step, 0); });
    else if (options.algorithm != Algorithm::scan)
      found = within_budget([&] {
        return epsilon_constraint(session,
                                  [&] { return within_budget([&] { return search_with_restarts(session); }); });
      });
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
    outcome.message = words_of(outcome) + "; of points that looked like a compromise " + refused_words(finer) +
                      ", and the one there is now was not looked at";
  else if (all_refused(session))
    outcome.message = words_of(outcome) + "; " + refused_words(finer);
  return outcome;
}

}  // namespace dovetail::optimizer
