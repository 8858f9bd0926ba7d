#pragma once

#include <optional>
#include <string>
#include <vector>

#include "optimizer/accuracy/choice.hpp"
#include "studies/program/questions/solver_choice.hpp"
#include "studies/program/study_file/study.hpp"

namespace dovetail::studies {

/// What solver.accuracy asks of a study: of the responses that its objective and limits name, at settings that the file
/// does not give. Nothing where it asks for no accuracy, or of no response that is known until then.
/// - `until`: responses that need a later stage are not asked
[[nodiscard]] std::optional<optimizer::AccuracyGoal> accuracy_goal(
    const Study& study, optimizer::Stage until = optimizer::Stage::worn_resonance);

/// The same of the harmonics and samples that are to be chosen automatically; nothing where none are.
/// - `until`: responses that need a later stage are not asked
[[nodiscard]] std::optional<optimizer::AccuracyGoal> truncation_goal(const Study& study, const SolverChoice& solver,
                                                                     optimizer::Stage until);

/// Settings for that, of the study's own design: computed once, and then as if they stood in its file. The study's
/// scene has them from then on.
/// @return nothing where there is no goal
std::optional<optimizer::SettingsChoice> settle(Study& study, const std::optional<optimizer::AccuracyGoal>& goal,
                                                const optimizer::AccuracyListener& told = {},
                                                const optimizer::AccuracyMemory& memory = {});

/// Whole bar over what settings buy of it from which it is told.
inline constexpr double kTellWhole = 1.05;

/// Of the responses that an accuracy is asked of, the one whose whole bar, with what no setting buys of it, is largest
/// over what was asked; nothing where none has a bar. With cases also of what objective and limits make of them.
/// - `asked_history`: of doubts of worn states; where none was, what only a history would settle does not count
[[nodiscard]] std::optional<optimizer::Dominant> whole_bar(const optimizer::Problem& problem,
                                                           const optimizer::AccuracyGoal& goal,
                                                           const optimizer::Evaluation& evaluation,
                                                           bool asked_history = true);
/// What a tenth of the bars would cost; empty where not even what was asked is reached.
[[nodiscard]] std::string digit_words(const optimizer::SettingsChoice& choice);

/// What of an accuracy asked for holds at a design that was computed with bars.
struct AccuracyHeld {
  bool reached = false;  ///< with all parts of the bars
  std::string words = {};
  std::vector<std::string> not_held = {};  ///< without a value or a bar, and so held to none
};
/// - `asked_history`: see whole_bar
[[nodiscard]] AccuracyHeld accuracy_held(const optimizer::Problem& problem, const optimizer::Scene& scene,
                                         const optimizer::AccuracyGoal& goal, const optimizer::Evaluation& evaluation,
                                         bool asked_history = true);

/// A round in a line for people.
[[nodiscard]] std::string round_words(const Study& study, const optimizer::SettingsTried& tried);
/// Which of several rounds was taken; empty after one.
[[nodiscard]] std::string taken_words(const Study& study, const optimizer::SettingsChoice& choice);
/// What was not reached or not held to it, why, and which keys of the study file keep it from being bought; empty where
/// everything was.
[[nodiscard]] std::string accuracy_complaint(const Study& study, const optimizer::SettingsChoice& choice);

}  // namespace dovetail::studies
