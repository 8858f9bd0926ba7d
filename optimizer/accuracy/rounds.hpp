#pragma once

#include <optional>
#include <string>
#include <vector>

#include "optimizer/accuracy/choice.hpp"
#include "optimizer/accuracy/known_rounds.hpp"

namespace dovetail::optimizer {

/// The rounds of a choice of settings, and what follows from them. What it is made of outlives it.
class Rounds {
 public:
  Rounds(const Scene& scene, const AccuracyGoal& goal, const AccuracyProbe& probe);

  [[nodiscard]] Settings first() const;
  /// An evaluation, and what it says of all settings. What is returned holds until the next one.
  const SettingsTried& ask(const Settings& at);
  /// What is worth another round; nothing where the choice is made.
  [[nodiscard]] std::optional<Settings> next();
  [[nodiscard]] SettingsChoice choice() const;

 private:
  /// What the rounds say of bars of the responses that nothing is asked of: the settings were taken where bars of
  /// others were small, and those may be, too.
  [[nodiscard]] BarParts raised_beside(const KnownRound& best) const;
  [[nodiscard]] bool is_own(Settings at) const;  // but for the histories, which no round asks
  void leave_out(const Settings& settings);
  /// Those whose mesh may resolve all that is asked of; none where the finest one is known not to.
  [[nodiscard]] std::vector<Settings> may_resolve() const;

  const Scene& scene_;
  const AccuracyGoal& goal_;
  const AccuracyProbe& probe_;
  Settings own_;
  std::vector<Settings> all_;  // those that may still do
  Forecast forecast_;          // after the last round with bars
  std::vector<SettingsTried> tried_;
  std::vector<KnownRound> known_;
  std::vector<std::string> not_held_;
  std::optional<double> out_of_reach_;
  bool ran_idle_ = false;
  double unit_ = kInfinity;  // operations of the scene's own settings; unknown before the first round with bars
  double work_ = 0;          // of rounds from that on; of those that failed what was foreseen
  std::optional<double> work_refused_;
};

}  // namespace dovetail::optimizer
