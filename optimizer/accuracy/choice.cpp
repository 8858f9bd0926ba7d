#include "optimizer/accuracy/choice.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "optimizer/accuracy/params.hpp"
#include "optimizer/bars/bars.hpp"
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
  const double tenth = choice.tried.excess / 10;
  Settings there = cheapest(all, forecast, tenth);
  if (forecast.excess(there) > tenth) return {};
  there.history_tolerance = history_tolerance;
  return SettingsChoice::Digit{.settings = there,
                               .times_as_long = forecast.operations(there) / forecast.operations(choice.settings)};
}

/// A round that has bars.
struct Known {
  SettingsTried tried;
  Evaluation evaluation;
  Forecast alone, forecast;  ///< before and after the others were heard
};

/// Rounds whose bars do not meet contradict each other, and nothing says which bar is too small: both reach to where
/// the other begins. One that contradicts most of the others is out of line, and heard no more.
void judge(std::vector<Known>& rounds) {
  const auto contradicted = [&](const Known& round) {
    return std::ranges::count_if(rounds, [&](const Known& other) { return !round.alone.meets(other.alone); });
  };
  for (Known& round : rounds)
    round.tried.out_of_line = rounds.size() > 2 && 2 * contradicted(round) > static_cast<int>(rounds.size()) - 1;
  if (std::ranges::all_of(rounds, [](const Known& round) { return round.tried.out_of_line; }))
    for (Known& round : rounds) round.tried.out_of_line = false;  // there is no line
  for (Known& round : rounds) {
    round.forecast = round.alone;
    for (const Known& other : rounds)
      if (!other.tried.out_of_line) round.forecast.reach(other.alone);
    round.tried.by = round.forecast.dominant();
    round.tried.excess = round.forecast.excess(round.tried.settings);
  }
}

/// The cheapest that is accurate enough; where none is, of those that are hardly less accurate than the best of them:
/// what is missed all the same is not paid for.
const Known& best_of(const std::vector<Known>& rounds) {
  double least = kInfinity;
  for (const Known& round : rounds)
    if (!round.tried.out_of_line) least = std::min(least, round.tried.excess);
  const double limit = least <= 1 ? 1 : kParams.hardly_worse * least;
  const auto rank = [limit](const Known& round) {
    return std::pair{round.tried.out_of_line || round.tried.excess > limit, round.tried.operations};
  };
  return *std::ranges::min_element(rounds, {}, rank);
}

struct Foreseen {
  Settings settings;
  double excess;
};

/// What should do by the last round; where by that one nothing would, by the round before that foresees the least: one
/// may be out of line.
Foreseen foreseen(const std::vector<Settings>& all, const Forecast& last, std::span<const Known> rounds) {
  const auto by = [&](const Forecast& forecast) {
    const Settings there = cheapest(all, forecast, kParams.aim);
    return Foreseen{.settings = there, .excess = forecast.excess(there)};
  };
  Foreseen least = by(last);
  for (const Known& round : rounds) {
    if (least.excess <= 1) break;
    Forecast before = round.forecast;
    before.take_orders(last);
    if (const Foreseen other = by(before); other.excess < least.excess) least = other;
  }
  return least;
}

/// What the mesh beside the flanks leaves of each response, from the design on one that is coarser there.
std::map<std::string, double> left_beside(const Scene& reference, const Scene& scene, Settings settings,
                                          Purpose purpose, const Evaluation& here) {
  settings.beside /= kParams.coarser_beside;
  purpose.bars = false;
  const Evaluation there =
      SceneEvaluator(with_settings(reference, settings)).evaluate(with_settings(scene, settings), purpose).evaluation;
  std::map<std::string, double> leaves;
  // Without an answer there as much may be left beside the flanks as along them.
  if (!there.converged())
    for (const auto& [name, bars] : here.error_sources)
      if (const auto mesh = bars.find("mesh"); mesh != bars.end()) leaves[name] = mesh->second / 2;
  for (const auto& [name, value] : there.responses)
    if (const auto own = here.responses.find(name); own != here.responses.end())
      leaves[name] =
          std::abs(value - own->second) * left_over(find_response(name)->mesh_order.in_plane, kParams.coarser_beside);
  return leaves;
}

}  // namespace

SettingsChoice choose_settings(const Scene& scene, const AccuracyGoal& goal, const AccuracyProbe& probe,
                               const AccuracyListener& told) {
  std::vector<Settings> all = all_settings(scene, goal.fixed, strictest(goal));
  SettingsChoice choice;
  choice.settings = settings_of(scene);
  Forecast forecast(scene, goal);
  std::vector<Known> known;
  Settings next = choice.settings;
  double work = 0, allowed = kInfinity;
  bool spent = false;
  next.history_tolerance = all.front().history_tolerance;
  // In space the own mesh may cost as much as all coarser ones together: what those foresee leads there.
  if (scene.kind->in_space) next.mesh = all.front().mesh;
  if (std::ranges::find(all, next) == all.end()) next = towards(next, all, next);  // too few samples
  while (static_cast<int>(choice.rounds.size()) < kParams.rounds) {
    auto [evaluation, beside] = probe(next);
    SettingsTried tried{.settings = next, .status = evaluation.status};
    std::optional<Dominant> by;
    if (evaluation.converged()) {
      forecast.add(next, evaluation, beside);
      by = forecast.dominant();
      tried.operations = forecast.operations(next);
      if (known.empty()) {
        choice.not_held = forecast.not_held();
        if (scene.solver.accuracy_work > 0) allowed = scene.solver.accuracy_work * forecast.operations(choice.settings);
      }
    }
    if (by) {
      known.push_back({.tried = tried, .evaluation = std::move(evaluation), .alone = forecast, .forecast = forecast});
      judge(known);
      tried = known.back().tried;
      for (const Known& round : known)
        if (round.tried.excess > 1 && all.size() > 1) std::erase(all, round.tried.settings);  // known not to do
    } else if (all.size() > 1) {
      std::erase(all, next);
    }
    choice.rounds.push_back(tried);
    if (!known.empty()) work += known.back().forecast.operations(next);
    const bool go_on = !told || told(tried);
    if (!go_on) break;
    if (known.empty()) {
      // On the coarsest mesh there may be no answer where there is one on the own.
      if (choice.rounds.size() > 1 || next.mesh == choice.settings.mesh) break;
      next.mesh = choice.settings.mesh;
      continue;
    }
    const SettingsTried& best = best_of(known).tried;
    if (best.excess <= 1 && !goal.many) break;
    const Foreseen there = foreseen(all, known.back().forecast, best.excess > 1 ? known : std::span<const Known>());
    // Of two that contradict each other a third says more.
    const bool two_apart = known.size() == 2 && !known.front().alone.meets(known.back().alone);
    if (there.excess > 1 && best.excess > 1 && known.size() > 1 && !two_apart) {
      choice.out_of_reach = there.excess;
      break;
    }
    const Settings wanted = towards(there.settings, all, next);
    const bool tried_before = std::ranges::find(choice.rounds, wanted, &SettingsTried::settings) != choice.rounds.end();
    const bool hardly_cheaper =
        best.excess <= 1 && known.back().forecast.operations(wanted) > kParams.worth * best.operations;
    if (tried_before || hardly_cheaper) break;
    spent = work + known.back().forecast.operations(wanted) > allowed;
    if (spent) break;
    next = wanted;
  }
  for (SettingsTried& round : choice.rounds)
    if (const auto of = std::ranges::find(known, round.settings, [](const Known& k) { return k.tried.settings; });
        of != known.end())
      round = of->tried;
  if (known.empty()) {
    choice.status = Status::stalled;
    return choice;
  }
  const Known& best = best_of(known);
  choice.settings = best.tried.settings;
  choice.tried = best.tried;
  choice.evaluation = best.evaluation;
  choice.raised = best.forecast.raised();
  raise_bars(choice.raised, choice.evaluation);
  choice.not_held = best.forecast.not_held();
  choice.status = choice.tried.excess <= 1 ? Status::converged : spent ? Status::budget_spent : Status::iteration_limit;
  choice.one_more_digit =
      one_more_digit(all, best.forecast, choice, history_tolerance(scene, goal.fixed, strictest(goal) / 10));
  return choice;
}

SettingsChoice choose_settings(const Scene& reference, const Scene& scene, const AccuracyGoal& goal,
                               const AccuracyListener& told) {
  Purpose purpose{.truncation_alone = goal.of_truncation, .history = false};
  if (goal.until)
    purpose.until = *goal.until;
  else if (!goal.responses.empty())
    purpose.until = last_stage(goal.responses);
  const bool beside = chooses_beside(scene, goal.fixed) && !goal.of_truncation;
  return choose_settings(
      scene, goal,
      [&](const Settings& settings) -> AccuracyAnswer {
        Evaluation found = SceneEvaluator(with_settings(reference, settings), goal.responses)
                               .evaluate(with_settings(scene, settings), purpose)
                               .evaluation;
        std::map<std::string, double> leaves;
        if (beside && found.converged()) leaves = left_beside(reference, scene, settings, purpose, found);
        return {std::move(found), std::move(leaves)};
      },
      told);
}

}  // namespace dovetail::optimizer
