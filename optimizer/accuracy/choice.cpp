#include "optimizer/accuracy/choice.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "optimizer/accuracy/params.hpp"
#include "optimizer/responses/response_table.hpp"

namespace dovetail::optimizer {

namespace {

constexpr SettingsParams kParams;

/// Those whose parts of bars are foreseen by orders that may be off.
constexpr std::array kKnobs{Knob::mesh, Knob::harmonics, Knob::samples, Knob::modes};

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
                                                    const SettingsChoice& choice) {
  const double tenth = choice.tried.excess / 10;
  const Settings there = cheapest(all, forecast, tenth);
  if (forecast.excess(there) > tenth) return {};
  return SettingsChoice::Digit{.settings = there,
                               .times_as_long = forecast.operations(there) / forecast.operations(choice.settings)};
}

bool better(const SettingsTried& a, const SettingsTried& b) {
  const bool a_does = a.excess <= 1, b_does = b.excess <= 1;
  if (a_does != b_does) return a_does;
  return a_does ? a.operations < b.operations : a.excess < b.excess;
}

}  // namespace

SettingsChoice choose_settings(const Scene& scene, const AccuracyGoal& goal, const AccuracyProbe& probe,
                               const AccuracyListener& told) {
  std::vector<Settings> all = all_settings(scene, goal.fixed, strictest(goal));
  SettingsChoice choice;
  choice.settings = settings_of(scene);
  Forecast forecast(scene, goal);
  std::optional<Forecast> best;
  Settings next = choice.settings;
  next.history_tolerance = all.front().history_tolerance;
  if (std::ranges::find(all, next) == all.end()) next = all.front();  // samples that alias
  for (int round = 0, answers = 0; round < kParams.rounds; ++round) {
    const Evaluation evaluation = probe(next);
    SettingsTried tried{.settings = next, .status = evaluation.status};
    if (evaluation.converged()) {
      forecast.add(next, evaluation);
      tried.by = forecast.dominant();
      if (tried.by) tried.excess = forecast.excess(next);
      tried.operations = forecast.operations(next);
      if (!best) choice.not_held = forecast.not_held();
    }
    if (tried.by) {
      if (!best || better(tried, choice.tried)) {
        choice.settings = next;
        choice.tried = tried;
        choice.evaluation = evaluation;
        choice.not_held = forecast.not_held();
        best = forecast;
      }
    } else {
      std::erase(all, next);
    }
    choice.rounds.push_back(tried);
    const bool go_on = !told || told(tried);
    if (!best || !go_on) break;
    const Settings there = cheapest(all, forecast, kParams.aim);
    answers += evaluation.converged() ? 1 : 0;
    if (const double least = forecast.excess(there); least > 1 && choice.tried.excess > 1 && answers > 1) {
      choice.out_of_reach = least;
      break;
    }
    const Settings wanted = towards(there, all, next);
    const bool known = std::ranges::any_of(choice.rounds, [&](const SettingsTried& t) { return t.settings == wanted; });
    const bool hardly_cheaper =
        choice.tried.excess <= 1 && forecast.operations(wanted) > kParams.worth * choice.tried.operations;
    if (known || hardly_cheaper) break;
    next = wanted;
  }
  if (!best) {
    choice.status = Status::stalled;
    return choice;
  }
  choice.status = choice.tried.excess <= 1 ? Status::converged : Status::iteration_limit;
  choice.one_more_digit = one_more_digit(all, *best, choice);
  return choice;
}

SettingsChoice choose_settings(const Scene& reference, const Scene& scene, const AccuracyGoal& goal,
                               const AccuracyListener& told) {
  Purpose purpose{.truncation_alone = goal.of_truncation, .history = false};
  if (!goal.responses.empty()) purpose.until = last_stage(goal.responses);
  return choose_settings(
      scene, goal,
      [&](const Settings& settings) {
        return SceneEvaluator(with_settings(reference, settings), goal.responses)
            .evaluate(with_settings(scene, settings), purpose)
            .evaluation;
      },
      told);
}

}  // namespace dovetail::optimizer
