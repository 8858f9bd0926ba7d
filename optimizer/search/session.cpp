#include "optimizer/search/session.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "optimizer/search/params.hpp"

namespace dovetail::optimizer {

EvaluationSession::EvaluationSession(const Problem& problem, const Evaluator& evaluator,
                                     const OptimizerOptions& options, const RunHooks& hooks)
    : problem_(problem),
      evaluator_(evaluator),
      options_(options),
      hooks_(hooks),
      limit_(static_cast<std::size_t>(options.max_evaluations)),
      shifts_(constraint_names(problem).size(), 0.0) {
  if (hooks_.journal == nullptr) return;
  const std::vector<JournalRecord>& records = hooks_.journal->records();
  for (std::size_t i = 0; i < records.size(); ++i) in_journal_.insert(records[i].x, i);
}

std::vector<double> EvaluationSession::snap(std::span<const double> unit) {
  std::vector<double> snapped(unit.size());
  for (std::size_t i = 0; i < unit.size(); ++i) {
    // A library that lost its way may ask for NaN: the lower bound is as good as any answer to that.
    const double u = std::isnan(unit[i]) ? 0.0 : std::clamp(unit[i], 0.0, 1.0);
    snapped[i] = std::nearbyint(u * 0x1.0p40) * 0x1.0p-40;
  }
  return snapped;
}

std::size_t EvaluationSession::evaluate_start() {
  const std::vector<double> x = problem_.space.start();
  std::vector<Pending> pending(1);
  pending[0].unit = snap(problem_.space.to_unit(x));
  pending[0].x = x;
  compute(pending, kStartPhase);
  return 0;
}

std::size_t EvaluationSession::evaluate(std::span<const double> unit, const std::string& phase) {
  return evaluate_all({std::vector<double>(unit.begin(), unit.end())}, phase).front();
}

std::vector<std::size_t> EvaluationSession::evaluate_all(const std::vector<std::vector<double>>& units,
                                                         const std::string& phase) {
  stop_if_asked();
  std::vector<Pending> pending;
  std::vector<std::vector<double>> snapped;
  const std::size_t known = candidates_.size();
  ExactCache here;
  bool budget_ends = false;
  for (const std::vector<double>& asked : units) {
    snapped.push_back(snap(asked));
    const std::vector<double>& u = snapped.back();
    if (by_unit_.find(u) || here.find(u)) {
      ++statistics_.repeated;
      continue;
    }
    std::vector<double> x = problem_.space.from_unit(u);
    if (const auto same = by_value_.find(x)) {
      by_unit_.insert(u, *same);
      ++statistics_.repeated;
      continue;
    }
    if (known + pending.size() >= limit_ || (time_over() && !in_journal_.find(x))) {
      budget_ends = true;
      break;
    }
    here.insert(u, pending.size());
    pending.push_back({.unit = u, .x = std::move(x)});
  }
  repeats_in_a_row_ = pending.empty() ? repeats_in_a_row_ + 1 : 0;
  compute(pending, phase);
  if (budget_ends) throw StopSearch{Status::iteration_limit};
  if (repeats_in_a_row_ > kMostRepeatsInARow) {
    repeats_in_a_row_ = 0;
    throw StopSearch{Status::stalled};
  }
  std::vector<std::size_t> indices;
  for (const std::vector<double>& u : snapped) indices.push_back(by_unit_.find(u).value());
  return indices;
}

void EvaluationSession::compute(std::vector<Pending>& pending, const std::string& phase) {
  std::size_t missing = 0;
  for (Pending& candidate : pending) {
    if (const auto record = in_journal_.find(candidate.x))
      candidate.known = &hooks_.journal->records()[*record].evaluation;
    else
      ++missing;
  }
  if (hooks_.many && missing > 0) return compute_at_once(pending, phase);
  for (Pending& candidate : pending) {
    stop_if_asked();
    if (candidate.known == nullptr) {
      if (time_over()) throw StopSearch{Status::iteration_limit};
      call_evaluator(candidate);
      if (candidate.error) std::rethrow_exception(candidate.error);
    }
    commit(candidate, phase);
  }
}

void EvaluationSession::compute_at_once(std::vector<Pending>& pending, const std::string& phase) {
  stop_if_asked();
  std::vector<std::vector<double>> asked;
  std::vector<Pending*> places;
  for (Pending& candidate : pending) {
    candidate.done = candidate.known != nullptr;
    if (candidate.done) continue;
    asked.push_back(candidate.x);
    places.push_back(&candidate);
  }
  // The first in order is recorded as soon as it is there: a crash loses at most what is under way.
  auto next = pending.begin();
  const auto commit_those_in_order = [&] {
    for (; next != pending.end() && next->done; ++next) commit(*next, phase);
  };
  commit_those_in_order();
  hooks_.many(asked, [&](std::size_t place, Evaluation evaluation) {
    places[place]->evaluation = std::move(evaluation);
    places[place]->done = true;
    commit_those_in_order();
    return (hooks_.stop == nullptr || !hooks_.stop->load()) && !time_over();
  });
  // Of a run that was stopped, also those behind one that was not begun.
  bool all = true;
  for (; next != pending.end(); ++next)
    if (next->done)
      commit(*next, phase);
    else
      all = false;
  stop_if_asked();
  if (!all) throw StopSearch{Status::iteration_limit};
}

void EvaluationSession::call_evaluator(Pending& candidate) const {
  try {
    candidate.evaluation = evaluated_or_refused([&] { return evaluator_(candidate.x); });
  } catch (...) {
    candidate.error = std::current_exception();
  }
}

void EvaluationSession::commit(Pending& candidate, const std::string& phase) {
  const bool replayed = candidate.known != nullptr;
  if (replayed) candidate.evaluation = *candidate.known;
  Evaluation evaluation = std::move(candidate.evaluation);
  if (evaluation.parameters.empty()) evaluation.parameters = problem_.space.settings(candidate.x);
  // A response no evaluation has is a mistake in the study; one that is missing later is a failure of that candidate.
  if (evaluation.converged() && !responses_known_) {
    require_responses(problem_, evaluation);
    responses_known_ = true;
  }
  annotate(problem_, options_.constraint_tolerance, evaluation);
  if (!replayed && hooks_.journal != nullptr) hooks_.journal->append(candidate.x, evaluation);

  const std::size_t index = candidates_.size();
  by_unit_.insert(candidate.unit, index);
  by_value_.insert(candidate.x, index);
  units_.push_back(candidate.unit);
  const Judgement judgement = judged(index, evaluation);
  ++(replayed ? statistics_.replayed : statistics_.computed);
  if (evaluation.infeasible())
    ++statistics_.infeasible;
  else if (!judgement.computed)
    ++statistics_.failed;
  candidates_.push_back({.x = candidate.x,
                         .evaluation = std::move(evaluation),
                         .judgement = judgement,
                         .phase = phase,
                         .replayed = replayed});
  if (judgement.feasible && (!best_ || better(judgement, candidates_[*best_].judgement))) best_ = index;
  if (hooks_.progress) hooks_.progress({.index = index, .candidate = candidates_.back(), .best = best_});
}

void EvaluationSession::limit(std::size_t candidates) {
  limit_ = std::min(candidates, static_cast<std::size_t>(options_.max_evaluations));
}

void EvaluationSession::shift_constraints(std::vector<double> shifts) {
  shifts_ = std::move(shifts);
  judge_again();
}

void EvaluationSession::reject(std::size_t index) {
  rejected_.push_back(index);
  judge_again();
}

void EvaluationSession::accept(std::size_t index) {
  accepted_.push_back(index);
  judge_again();
}

bool EvaluationSession::accepted(std::size_t index) const {
  return std::ranges::find(accepted_, index) != accepted_.end();
}

void EvaluationSession::focus(std::optional<Focus> on) {
  focus_ = std::move(on);
  judge_again();
}

Judgement EvaluationSession::judged(std::size_t index, const Evaluation& evaluation) const {
  const std::span<const double> shifts = accepted(index) ? std::span<const double>{} : shifts_;
  Judgement judgement = judge(problem_, evaluation, options_.constraint_tolerance, shifts);
  if (std::ranges::find(rejected_, index) != rejected_.end()) judgement.feasible = false;
  if (!focus_) return judgement;
  judgement.objective =
      std::inner_product(judgement.terms.begin(), judgement.terms.end(), focus_->weights.begin(), 0.0);
  for (std::size_t i = 0; i < judgement.terms.size(); ++i) {
    if (std::isinf(focus_->most[i])) continue;
    const double c = (judgement.terms[i] - focus_->most[i]) / focus_->size[i];  // NaN unless computed
    judgement.constraints.push_back(c);
    if (!judgement.computed) continue;
    judgement.violation += std::max(0.0, c);
    judgement.feasible = judgement.feasible && c <= options_.constraint_tolerance;
  }
  return judgement;
}

void EvaluationSession::judge_again() {
  best_.reset();
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    Judgement& judgement = candidates_[i].judgement;
    judgement = judged(i, candidates_[i].evaluation);
    if (judgement.feasible && (!best_ || better(judgement, candidates_[*best_].judgement))) best_ = i;
  }
}

void EvaluationSession::stop_if_asked() const {
  if (hooks_.stop != nullptr && hooks_.stop->load()) throw StopSearch{Status::interrupted};
}

std::optional<std::size_t> EvaluationSession::least_broken() const {
  std::optional<std::size_t> least;
  const auto rank = [&](std::size_t i) {
    const Candidate& c = candidates_[i];
    return std::pair{!c.judgement.computed, c.judgement.violation};
  };
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    const bool failed = !candidates_[i].judgement.computed && !candidates_[i].evaluation.infeasible();
    if (!failed && (!least || rank(i) < rank(*least))) least = i;
  }
  return least;
}

std::optional<std::size_t> EvaluationSession::refused_by_shifts() const {
  std::optional<std::size_t> least;
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    const Candidate& c = candidates_[i];
    if (!c.evaluation.feasible || c.judgement.feasible || std::ranges::find(rejected_, i) != rejected_.end()) continue;
    if (!least || c.judgement.violation < candidates_[*least].judgement.violation) least = i;
  }
  return least;
}

int EvaluationSession::unused_records() const {
  return static_cast<int>(in_journal_.size()) - statistics_.replayed;
}

}  // namespace dovetail::optimizer
