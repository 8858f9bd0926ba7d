#include "studies/program/engine/settled_study.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "studies/program/engine/engine.hpp"

namespace dovetail::studies {

std::optional<optimizer::AccuracyGoal> accuracy_goal(const Study& study) {
  if (study.scene.solver.accuracy == 0) return {};
  optimizer::AccuracyGoal goal{.relative = study.scene.solver.accuracy};
  goal.responses = optimizer::responses_of(study.problem);
  goal.fixed = study.given;
  const auto own = [&goal](const auto& term) {
    if (term.accuracy > 0) goal.of[term.response] = term.accuracy;
  };
  for (const optimizer::ObjectiveTerm& term : study.problem.objective) own(term);
  for (const optimizer::ResponseConstraint& limit : study.problem.constraints) own(limit);
  return goal;
}

std::optional<optimizer::SettingsChoice> settle(Study& study, const optimizer::AccuracyListener& told) {
  const std::optional<optimizer::AccuracyGoal> goal = accuracy_goal(study);
  if (!goal) return {};
  optimizer::SettingsChoice choice = optimizer::choose_settings(reference_scene(study), study.scene, *goal, told);
  study.scene = optimizer::with_settings(study.scene, choice.settings);
  return choice;
}

std::string round_words(const Study& study, const optimizer::SettingsTried& tried) {
  const optimizer::Scene there = optimizer::with_settings(study.scene, tried.settings);
  std::string text = fmt::format("{} edges per flank, {} harmonics, {} samples, {} modes: ", there.mesh.flank_elements,
                                 there.solver.harmonics, there.solver.samples, there.solver.modes);
  if (!tried.by) return text + tried.status;
  return text + fmt::format("{} to {:.2g} % (asked: {:.2g} %), most of it by {}", tried.by->response,
                            100 * tried.by->relative, 100 * tried.by->asked, tried.by->source);
}

std::string accuracy_complaint(const optimizer::SettingsChoice& choice) {
  if (!choice.tried.by)
    return "no settings could be chosen: at the design's own ones no response asked for has a value and an error bar";
  if (choice.status == Status::converged && !choice.not_held.empty())
    return fmt::format("settings were chosen without {}: no value, or no error bar, says how accurate it is",
                       fmt::join(choice.not_held, ", "));
  if (choice.status == Status::converged) return {};
  return fmt::format(
      "the accuracy asked for is not reached: {} is known to {:.2g} %, asked for {:.2g} %; most of it is "
      "left by {}",
      choice.tried.by->response, 100 * choice.tried.by->relative, 100 * choice.tried.by->asked,
      choice.tried.by->source);
}

}  // namespace dovetail::studies
