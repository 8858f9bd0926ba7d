#include "optimizer/accuracy/rounds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <span>
#include <utility>

#include "optimizer/accuracy/params.hpp"
#include "optimizer/responses/response_table.hpp"
#include "optimizer/scene/scene_kind.hpp"

namespace dovetail::optimizer {

namespace {

constexpr SettingsParams kParams;

/// Those whose parts of bars are foreseen by orders that may be off.
constexpr std::array kKnobs{Knob::mesh, Knob::beside, Knob::harmonics, Knob::samples, Knob::modes};

/// The cheapest that should do; where none should, of those that are as good as the most accurate one.
Settings cheapest(const std::vector<Settings>& all, const Forecast& forecast, double allowed) {
  std::vector<double> excess;
  for (const Settings& settings : all) excess.push_back(forecast.excess(settings));
  const double least = *std::ranges::min_element(excess);
  const double limit = least <= allowed ? allowed : kParams.as_good * least;
  std::size_t best = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (excess[i] <= limit && (excess[best] > limit || forecast.operations(all[i]) < forecast.operations(all[best])))
      best = i;
  return all[best];
}

/// On the way there no further than may be foreseen.
Settings towards(const Settings& there, const std::vector<Settings>& all, const Settings& at) {
  const auto rank = [&](const Settings& settings) {
    double too_far = 0, away = std::abs(std::log(finer(Knob::resonance, settings, there)));
    for (const Knob knob : kKnobs) {
      too_far += std::max(0.0, std::abs(std::log(finer(knob, settings, at))) - std::log(kParams.step));
      away += std::abs(std::log(finer(knob, settings, there)));
    }
    return std::pair{too_far, away};
  };
  return *std::ranges::min_element(all, {}, rank);
}

double strictest(const AccuracyGoal& goal) {
  double least = goal.relative;
  for (const auto& [response, asked] : goal.of) least = std::min(least, asked);
  return least;
}

std::optional<SettingsChoice::Digit> one_more_digit(const std::vector<Settings>& all, const Forecast& forecast,
                                                    const SettingsChoice& choice, double history_tolerance) {
  // No bar is left to be divided, or none is known.
  if (choice.tried.excess == 0 || !std::isfinite(choice.tried.excess)) return {};
  const double tenth = choice.tried.excess / 10;
  if (choice.out_of_reach && tenth < *choice.out_of_reach) return {};
  Settings there = cheapest(all, forecast, tenth);
  if (forecast.excess(there) > tenth) return {};
  there.history_tolerance = history_tolerance;
  return SettingsChoice::Digit{.settings = there,
                               .times_as_long = forecast.operations(there) / forecast.operations(choice.settings)};
}

struct Foreseen {
  Settings settings;
  double excess;
};

/// What should do by the last round; where by that one nothing would, by the round before that foresees the least: one
/// may be out of line.
/// @param resolved  only rounds that resolve all that is asked of count
Foreseen foreseen(const std::vector<Settings>& all, const Forecast& last, std::span<const KnownRound> rounds,
                  bool resolved) {
  const auto by = [&](const Forecast& forecast) {
    const Settings there = cheapest(all, forecast, kParams.aim);
    return Foreseen{.settings = there, .excess = forecast.excess(there)};
  };
  Foreseen least = by(last);
  for (const KnownRound& round : rounds) {
    if (least.excess <= 1) break;
    if (resolved && !round.forecast.resolves()) continue;
    Forecast before = round.forecast;
    before.take_orders(last);
    if (const Foreseen other = by(before); other.excess < least.excess) least = other;
  }
  return least;
}

}  // namespace

Rounds::Rounds(const Scene& scene, const AccuracyGoal& goal, const AccuracyProbe& probe)
    : scene_(scene),
      goal_(goal),
      probe_(probe),
      own_(settings_of(scene)),
      all_(all_settings(scene, goal.fixed, strictest(goal))),
      forecast_(scene, goal) {}

Settings Rounds::first() const {
  Settings first = own_;
  first.history_tolerance = all_.front().history_tolerance;
  // In space the own mesh may cost as much as all coarser ones together: what those foresee leads there.
  if (scene_.kind->in_space) first.mesh = all_.front().mesh;
  const bool listed = std::ranges::find(all_, first) != all_.end();
  return listed ? first : towards(first, all_, first);  // not where samples are too few
}

const SettingsTried& Rounds::ask(const Settings& at) {
  AccuracyAnswer answer = probe_(at);
  const Evaluation& evaluation = answer.evaluation;
  SettingsTried& tried = tried_.emplace_back(SettingsTried{.settings = at, .status = evaluation.status});
  if (evaluation.converged()) {
    forecast_.add(at, evaluation, answer.beside);
    tried.by = forecast_.dominant();
    tried.operations = forecast_.operations(at);
    if (known_.empty()) not_held_ = forecast_.not_held();
    // From elsewhere it is a forecast.
    if (known_.empty() || is_own(at)) unit_ = forecast_.operations(own_);
  }
  if (tried.by) {
    known_.push_back({.tried = tried, .answer = std::move(answer), .alone = forecast_, .forecast = forecast_});
    judge(known_);
    tried = known_.back().tried;
    for (const KnownRound& round : known_)
      if (round.tried.excess > 1) leave_out(round.tried.settings);  // known not to do
  } else {
    leave_out(at);
  }
  if (!known_.empty()) work_ += known_.back().forecast.operations(at);
  return tried;
}

std::optional<Settings> Rounds::next() {
  if (static_cast<int>(tried_.size()) == kParams.rounds) return {};
  if (known_.empty()) {
    // On the coarsest mesh there may be no answer where there is one on the own.
    Settings there = tried_.back().settings;
    there.mesh = own_.mesh;
    return tried_.size() > 1 || there == tried_.back().settings ? std::nullopt : std::optional(there);
  }
  const KnownRound& best = best_of(known_);
  const bool resolved = best.forecast.resolves();
  std::vector<Settings> open = may_resolve();
  const bool climbs = !resolved && !open.empty();
  if (open.empty() && (resolved || !best.forecast.knows())) return {};
  if (open.empty()) open = all_;  // no mesh resolves it: the rest of what is asked counts
  const double excess = climbs ? kInfinity : known_excess(best);
  if (excess <= 1 && !goal_.many) return {};
  ran_idle_ = excess > 1 && !climbs && runs_idle(known_);
  if (ran_idle_) return {};
  // One that does not resolve a response says nothing of it, and where none does the finest was tried for nothing.
  const bool from_best = !climbs && !known_.back().forecast.resolves();
  const Forecast& last = from_best ? best.forecast : known_.back().forecast;
  const Settings& at = from_best ? best.tried.settings : tried_.back().settings;
  const Foreseen there = foreseen(open, last, excess > 1 ? known_ : std::span<const KnownRound>(), resolved);
  // Of two that contradict each other a third says more.
  const bool two_apart = known_.size() == 2 && !known_.front().alone.meets(known_.back().alone);
  if (there.excess > 1 && excess > 1 && known_.size() > 1 && !two_apart) {
    out_of_reach_ = there.excess;
    return {};
  }
  const Settings wanted = towards(there.settings, climbs ? all_ : open, at);
  const double cost = last.operations(wanted);
  const bool hardly_cheaper = excess <= 1 && cost > kParams.worth * best.tried.operations;
  if (hardly_cheaper || std::ranges::find(tried_, wanted, &SettingsTried::settings) != tried_.end()) return {};
  const double work = (work_ + cost) / unit_, allowed = scene_.solver.accuracy_work;
  if (allowed == 0 || work <= allowed) return wanted;
  work_refused_ = work;
  return {};
}

SettingsChoice Rounds::choice() const {
  SettingsChoice choice;
  choice.settings = own_;
  choice.rounds = tried_;
  choice.not_held = not_held_;
  choice.out_of_reach = out_of_reach_;
  choice.ran_idle = ran_idle_;
  choice.work = work_ / unit_;
  choice.work_refused = work_refused_;
  for (SettingsTried& round : choice.rounds)
    for (const KnownRound& known : known_)
      if (known.tried.settings == round.settings) round = known.tried;
  if (known_.empty()) {
    choice.status = Status::stalled;
    return choice;
  }
  const KnownRound& best = best_of(known_);
  choice.settings = best.tried.settings;
  choice.tried = best.tried;
  choice.evaluation = best.answer.evaluation;
  choice.raised = best.forecast.raised();
  choice.raised.merge(raised_beside(best));
  raise_bars(choice.raised, choice.evaluation);
  choice.not_held = best.forecast.not_held();
  choice.status = best.tried.excess <= 1 ? Status::converged
                  : work_refused_        ? Status::budget_spent
                                         : Status::iteration_limit;
  choice.one_more_digit =
      one_more_digit(all_, best.forecast, choice, history_tolerance(scene_, goal_.fixed, strictest(goal_) / 10));
  return choice;
}

BarParts Rounds::raised_beside(const KnownRound& best) const {
  AccuracyGoal others = goal_;
  others.responses.clear();
  others.resolves = false;
  for (const Response& response : responses())
    if (std::ranges::find(goal_.responses, response.name) == goal_.responses.end())
      others.responses.emplace_back(response.name);
  if (goal_.responses.empty() || others.responses.empty()) return {};
  Forecast last(scene_, others);
  std::vector<Forecast> alone;
  for (const KnownRound& round : known_) {
    last.add(round.tried.settings, round.answer.evaluation, round.answer.beside);
    alone.push_back(last);
  }
  Forecast of_best = alone.at(static_cast<std::size_t>(&best - known_.data()));
  for (std::size_t i = 0; i < known_.size(); ++i)
    if (!known_[i].tried.out_of_line) of_best.reach(alone[i]);
  return of_best.raised();
}

bool Rounds::is_own(Settings at) const {
  at.history_tolerance = own_.history_tolerance;
  return at == own_;
}

std::vector<Settings> Rounds::may_resolve() const {
  double coarse = 0;
  for (const KnownRound& round : known_)
    if (!round.forecast.resolves()) coarse = std::max(coarse, round.tried.settings.mesh);
  const auto finer_than = [&](double mesh) {
    std::vector<Settings> finer;
    std::ranges::copy_if(all_, std::back_inserter(finer), [&](const Settings& s) { return s.mesh > mesh; });
    return finer;
  };
  // The next rung hardly will, unless it is the last.
  std::vector<Settings> by_a_step = finer_than(kParams.step * coarse);
  return by_a_step.empty() ? finer_than(coarse) : by_a_step;
}

void Rounds::leave_out(const Settings& settings) {
  if (all_.size() > 1) std::erase(all_, settings);
}

}  // namespace dovetail::optimizer
