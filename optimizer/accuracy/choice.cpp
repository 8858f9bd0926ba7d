#include "optimizer/accuracy/choice.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "optimizer/accuracy/params.hpp"
#include "optimizer/accuracy/rounds.hpp"
#include "optimizer/bars/bars.hpp"
#include "optimizer/responses/response_table.hpp"

namespace dovetail::optimizer {

namespace {

/// What the mesh beside the flanks leaves of each response, from the design on one that is coarser there.
std::map<std::string, double> left_beside(const Scene& reference, const Scene& scene, Settings settings,
                                          Purpose purpose, const Evaluation& here) {
  constexpr double kCoarser = SettingsParams{}.coarser_beside;
  settings.beside /= kCoarser;
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
      leaves[name] = std::abs(value - own->second) * left_over(find_response(name)->mesh_order.in_plane, kCoarser);
  return leaves;
}

}  // namespace

SettingsChoice choose_settings(const Scene& scene, const AccuracyGoal& goal, const AccuracyProbe& probe,
                               const AccuracyListener& told) {
  Rounds rounds(scene, goal, probe);
  for (std::optional<Settings> at = rounds.first(); at; at = rounds.next())
    if (const SettingsTried& tried = rounds.ask(*at); told && !told(tried)) break;
  return rounds.choice();
}

SettingsChoice choose_settings(const Scene& reference, const Scene& scene, const AccuracyGoal& goal,
                               const AccuracyListener& told, const AccuracyMemory& memory) {
  Purpose purpose{.truncation_alone = goal.of_truncation, .history = false};
  if (!goal.responses.empty()) purpose.until = last_stage(goal.responses);
  const bool beside = chooses_beside(scene, goal.fixed) && !goal.of_truncation;
  const auto computed = [&](const Settings& settings) -> AccuracyAnswer {
    Evaluation found = SceneEvaluator(with_settings(reference, settings), goal.responses)
                           .evaluate(with_settings(scene, settings), purpose)
                           .evaluation;
    std::map<std::string, double> leaves;
    if (beside && found.converged()) leaves = left_beside(reference, scene, settings, purpose, found);
    return {std::move(found), std::move(leaves)};
  };
  const auto probe = [&](const Settings& settings) {
    return memory ? memory(settings, [&] { return computed(settings); }) : computed(settings);
  };
  return choose_settings(scene, goal, probe, told);
}

}  // namespace dovetail::optimizer
