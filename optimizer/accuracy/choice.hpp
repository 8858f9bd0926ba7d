#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "optimizer/accuracy/settings.hpp"
#include "optimizer/evaluator.hpp"

namespace dovetail::optimizer {

/// How accurate which responses have to be: bar over value.
struct AccuracyGoal {
  double relative = 0.02;                   ///< > 0, of all that are held to it
  std::map<std::string, double> of = {};    ///< > 0, of single responses instead
  std::vector<std::string> responses = {};  ///< held to it; empty: all with a value, a bar and a limit
  std::set<std::string> fixed = {};         ///< keys that stay as they are

  [[nodiscard]] double asked(const std::string& response) const {
    const auto own = of.find(response);
    return own == of.end() ? relative : own->second;
  }
};

/// The part of a bar that counts most.
struct Dominant {
  std::string response = {}, source = {};
  double relative = 0;  ///< what settings buy of the bar of the response, over its value
  double whole = 0;     ///< the same with what no setting buys, but what a history would settle
  double asked = 0;     ///< the same that was asked for
};

/// One evaluation on the way.
struct SettingsTried {
  Settings settings;
  std::string status = {};          ///< of the evaluation
  double excess = kInfinity;        ///< largest bar over what is allowed; <= 1: accurate enough
  std::optional<Dominant> by = {};  ///< where bars are known
  double operations = 0;            ///< of the evaluation without its bars
};

/// Settings for the accuracy asked for, at least cost as far as bars foresee it.
struct SettingsChoice {
  /// converged: all responses are accurate enough; iteration_limit: not reached, these are the most accurate ones
  /// tried; stalled: no response asked for has a value and a bar at the first settings, which are the scene's own
  /// unless samples and harmonics there do not match, and they stay.
  Status status = Status::iteration_limit;
  Settings settings;
  SettingsTried tried;                ///< at those settings
  std::vector<SettingsTried> rounds;  ///< all
  Evaluation evaluation;              ///< at those settings, with bars
  std::vector<std::string> not_held;  ///< responses asked for that have no value or no bar there
  /// Foreseen for a tenth of the bars; without a value where no settings there are would reach it.
  struct Digit {
    Settings settings;
    double times_as_long = 1;
  };
  std::optional<Digit> one_more_digit;
};

/// A design with bars at other settings.
using AccuracyProbe = std::function<Evaluation(const Settings&)>;
/// Hears of every round.
using AccuracyListener = std::function<void(const SettingsTried&)>;

/// Rounds of an evaluation with bars, from whose parts the next settings follow: of all there are, the cheapest that
/// should be accurate enough. What no setting buys (doubts of the worn state, the edges of zones, the search of the
/// resonance) is left out of what is asked for.
[[nodiscard]] SettingsChoice choose_settings(const Scene& scene, const AccuracyGoal& goal, const AccuracyProbe& probe,
                                             const AccuracyListener& told = {});

/// The same on meshes of a reference, of the scene until the last stage that the responses of the goal need.
[[nodiscard]] SettingsChoice choose_settings(const Scene& reference, const Scene& scene, const AccuracyGoal& goal,
                                             const AccuracyListener& told = {});

}  // namespace dovetail::optimizer
