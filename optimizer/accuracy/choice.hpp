#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "optimizer/accuracy/forecast.hpp"
#include "optimizer/evaluator.hpp"

namespace dovetail::optimizer {

/// One evaluation on the way.
struct SettingsTried {
  Settings settings;
  std::string status = {};          ///< of the evaluation
  double excess = kInfinity;        ///< largest bar over what is allowed; <= 1: accurate enough
  std::optional<Dominant> by = {};  ///< where bars are known
  double operations = 0;            ///< of the evaluation without its bars
  bool out_of_line = false;         ///< its bars do not meet those of most other rounds: it was not heard
};

/// Settings for the accuracy asked for, at least cost as far as bars foresee it.
struct SettingsChoice {
  /// converged: all responses are accurate enough; iteration_limit: not reached, these are the cheapest of those
  /// tried that are hardly less accurate than the most accurate ones; budget_spent: the same, where the work that the
  /// scene allows for choosing ended it; stalled: no response asked for has a value and a bar at the first
  /// settings, which are the scene's own unless samples and harmonics there do not match (in space on the coarsest
  /// mesh), and they stay.
  Status status = Status::iteration_limit;
  Settings settings;
  SettingsTried tried;                ///< at those settings
  std::vector<SettingsTried> rounds;  ///< all, as all together say
  Evaluation evaluation;              ///< at those settings, with bars by all rounds
  BarParts raised;                    ///< parts of these that are larger than that evaluation alone says
  std::vector<std::string> not_held;  ///< responses asked for that have no value or no bar there
  /// Foreseen for a tenth of the bars; without a value where no settings there are would reach it.
  struct Digit {
    Settings settings;
    double times_as_long = 1;
  };
  std::optional<Digit> one_more_digit;
  /// Where no settings there are should be accurate enough: the least excess foreseen of any.
  std::optional<double> out_of_reach;
  bool ran_idle = false;               ///< the last rounds, at finer settings, were no more accurate than those before
  double work = 0;                     ///< of the rounds, in evaluations of the scene, both without bars
  std::optional<double> work_refused;  ///< what it would have been with a round that was refused for it
};

/// A design with bars at other settings.
struct AccuracyAnswer {
  Evaluation evaluation;
  std::map<std::string, double> beside;  ///< what the mesh beside the flanks leaves of each response, where it is known

  // What a probe that knows nothing of the latter returns is one.
  AccuracyAnswer(Evaluation with_bars, std::map<std::string, double> leaves = {})
      : evaluation(std::move(with_bars)), beside(std::move(leaves)) {}
};
using AccuracyProbe = std::function<AccuracyAnswer(const Settings&)>;
/// Hears of every round and says whether to go on.
using AccuracyListener = std::function<bool(const SettingsTried&)>;

/// An answer that was given before, or the one that it computes.
using AccuracyMemory = std::function<AccuracyAnswer(const Settings&, const std::function<AccuracyAnswer()>& compute)>;

/// Rounds of an evaluation with bars, from whose parts the next settings follow: of all there are, the cheapest that
/// should be accurate enough. What no setting buys (doubts of the worn state, the edges of zones) is left out of
/// what is asked for. Where after two rounds (three, where those contradict each other) none of them foresees settings
/// that would do, or rounds in a row bring nothing, it ends: finer ones cost ever more.
[[nodiscard]] SettingsChoice choose_settings(const Scene& scene, const AccuracyGoal& goal, const AccuracyProbe& probe,
                                             const AccuracyListener& told = {});

/// The same on meshes of a reference, of the scene until the last stage that the responses of the goal need.
[[nodiscard]] SettingsChoice choose_settings(const Scene& reference, const Scene& scene, const AccuracyGoal& goal,
                                             const AccuracyListener& told = {}, const AccuracyMemory& memory = {});

}  // namespace dovetail::optimizer
