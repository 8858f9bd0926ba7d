#include "studies/program/engine/settled_study.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/enum_names.hpp"
#include "optimizer/cases.hpp"
#include "optimizer/responses/response_table.hpp"
#include "studies/program/engine/engine.hpp"
#include "studies/program/engine/truncation_choice.hpp"

namespace dovetail::studies {

namespace {

/// Of what all cases wear off together: what each wears off alone.
std::string settled_name(const std::string& response) {
  const optimizer::Response* alone = optimizer::find_response(response)->alone;
  return alone == nullptr ? response : std::string(alone->name);
}

/// The responses of a study of which settings are chosen in one case.
std::vector<std::string> settled_responses(const Study& study) {
  std::vector<std::string> names;
  for (const std::string& name : optimizer::responses_of(study.problem)) {
    const std::string settled = settled_name(name);
    if (std::ranges::find(names, settled) == names.end()) names.push_back(settled);
  }
  return names;
}

}  // namespace

std::optional<optimizer::AccuracyGoal> accuracy_goal(const Study& study, optimizer::Stage until) {
  if (study.scene.solver.accuracy == 0) return {};
  optimizer::AccuracyGoal goal{.relative = study.scene.solver.accuracy};
  goal.responses = settled_responses(study);
  if (until < optimizer::Stage::worn_resonance) {
    if (goal.responses.empty())
      for (const optimizer::Response& response : optimizer::responses()) goal.responses.emplace_back(response.name);
    std::erase_if(goal.responses,
                  [&](const std::string& name) { return optimizer::find_response(name)->stage > until; });
    if (goal.responses.empty()) return {};
  }
  goal.fixed = study.given;
  const auto own = [&goal](const auto& term) {
    if (term.accuracy == 0) return;
    const auto [at, first] = goal.of.try_emplace(settled_name(term.response), term.accuracy);
    if (!first) at->second = std::min(at->second, term.accuracy);
  };
  for (const optimizer::ObjectiveTerm& term : study.problem.objective) own(term);
  for (const optimizer::ResponseConstraint& limit : study.problem.constraints) own(limit);
  return goal;
}

std::optional<optimizer::AccuracyGoal> truncation_goal(const Study& study, const SolverChoice& solver,
                                                       optimizer::Stage until) {
  if (!solver.automatic()) return {};
  optimizer::AccuracyGoal goal{.relative = 10 * accuracy(solver), .of_truncation = true};
  const std::vector<std::string> named = settled_responses(study);
  for (const optimizer::Response& response : optimizer::responses()) {
    const std::string name(response.name);
    if (response.stage <= until && (named.empty() || std::ranges::count(named, name) > 0))
      goal.responses.push_back(name);
  }
  for (const optimizer::Response* amplitude : {&optimizer::kPeakAmplitude, &optimizer::kWornPeakAmplitude})
    goal.of[std::string(amplitude->name)] = accuracy(solver);
  for (const auto& [key, value] : optimizer::settings_by_key(study.scene, optimizer::settings_of(study.scene)))
    goal.fixed.insert(key);
  if (solver.harmonics == kAutomatic) goal.fixed.erase("solver.harmonics");
  if (solver.samples == kAutomatic) goal.fixed.erase("solver.samples");
  return goal;
}

std::optional<optimizer::SettingsChoice> settle(Study& study, const std::optional<optimizer::AccuracyGoal>& goal,
                                                const optimizer::AccuracyListener& told,
                                                const optimizer::AccuracyMemory& memory) {
  if (!goal) return {};
  optimizer::SettingsChoice choice = optimizer::choose_settings(
      evaluator_reference(study), optimizer::in_first_case(study.scene, study.problem.cases), *goal, told, memory);
  study.scene = optimizer::with_settings(study.scene, choice.settings);
  return choice;
}

namespace {

/// How well the response is known that is known worst.
std::string known(const optimizer::Dominant& by) {
  if (!std::isfinite(by.relative)) return fmt::format("the mesh does not resolve {}", by.response);
  std::string text = fmt::format("{} to {:.3g} % (asked: {:.3g} %)", by.response, 100 * by.relative, 100 * by.asked);
  if (!by.source.empty()) text += ", most of it by " + by.source;
  // Doubts of the worn state, edges of zones; with harmonics and samples alone to be chosen, all else.
  if (by.whole > kTellWhole * by.relative)
    text += fmt::format("; {:.3g} % with what this does not buy", 100 * by.whole);
  return text;
}

/// What of the bars counts, and the largest part of each.
struct Counted {
  std::map<std::string, double> bars;
  std::map<std::string, std::pair<double, std::string>> largest;
};

Counted counted(const optimizer::Evaluation& evaluation, bool asked_history) {
  Counted result;
  for (const auto& [name, all] : evaluation.error_sources) {
    if (std::ranges::count(evaluation.unbounded, name) > 0) continue;
    double& bar = result.bars[name] = 0;
    auto& largest = result.largest[name];
    for (const auto& [source, part] : all) {
      if (source == "history" && !asked_history && evaluation.left_to_history()) continue;
      bar += part;
      largest = std::max(largest, std::pair(part, source));
    }
  }
  return result;
}

/// Of all cases that a number is of, the largest part of a bar.
std::string largest_of(const optimizer::Problem& problem, const optimizer::CaseNumber& number, const Counted& counted) {
  const std::string over(optimizer::split_case(number.name).load_case);
  const bool of_all = over.empty() || named<optimizer::Over>(over).has_value();
  std::pair<double, std::string> largest;
  for (const optimizer::LoadCase& load : problem.cases) {
    const auto found = counted.largest.find(optimizer::of_case(number.response, load.name));
    if (found != counted.largest.end() && (of_all || load.name == over || load.sample_of == over))
      largest = std::max(largest, found->second);
  }
  return largest.second;
}

}  // namespace

std::optional<optimizer::Dominant> whole_bar(const optimizer::Problem& problem, const optimizer::AccuracyGoal& goal,
                                             const optimizer::Evaluation& evaluation, bool asked_history) {
  std::optional<optimizer::Dominant> worst;
  const auto count = [&](const std::string& name, const std::string& response, double bar, double size,
                         const std::string& source) {
    const double relative = bar / size, asked = goal.asked(response);
    if (!std::isfinite(relative) || (worst && relative / asked <= worst->relative / worst->asked)) return;
    worst = optimizer::Dominant{
        .response = name, .source = source, .relative = relative, .whole = relative, .asked = asked};
  };
  const Counted of = counted(evaluation, asked_history);
  for (const auto& [name, bar] : of.bars) {
    if (!optimizer::split_case(name).load_case.empty()) continue;
    if (goal.responses.empty() || std::ranges::count(goal.responses, name) > 0)
      count(name, name, bar, std::abs(evaluation.responses.at(name)), of.largest.at(name).second);
  }
  // With cases those were the first one's, of which settings were chosen; what counts may be another's.
  if (!problem.cases.empty())
    for (const optimizer::CaseNumber& number : optimizer::numbers_asked(problem, evaluation.responses, of.bars))
      count(number.name, settled_name(number.response), number.number.bar, number.size,
            largest_of(problem, number, of));
  return worst;
}

std::string digit_words(const optimizer::SettingsChoice& choice) {
  if (choice.status != Status::converged) return {};
  if (!choice.one_more_digit) return "a tenth of these bars: no settings there are should leave as little";
  return fmt::format("a tenth of these bars: about {:.2g} times the work", choice.one_more_digit->times_as_long);
}

namespace {

/// Adds what objective and limits make of the cases where it has no relative accuracy.
void add_unknown(const optimizer::Problem& problem, const optimizer::Evaluation& evaluation,
                 std::vector<std::string>& names) {
  const auto of_a_case = [](const auto& bar) { return !optimizer::split_case(bar.first).load_case.empty(); };
  // Settings are chosen in the first case by itself.
  if (problem.cases.empty() || std::ranges::none_of(evaluation.error_sources, of_a_case)) return;
  const Counted of = counted(evaluation, true);
  for (const auto& [name, response, number, size] : optimizer::numbers_asked(problem, evaluation.responses, of.bars))
    if (!std::isfinite(number.bar / size) && std::ranges::count(names, name) == 0) names.push_back(name);
}

}  // namespace

AccuracyHeld accuracy_held(const optimizer::Problem& problem, const optimizer::Scene& scene,
                           const optimizer::AccuracyGoal& goal, const optimizer::Evaluation& evaluation,
                           bool asked_history) {
  std::optional<optimizer::Dominant> by;
  optimizer::Forecast bars(scene, goal);
  if (!evaluation.error_sources.empty()) {
    bars.add(optimizer::settings_of(scene), evaluation);
    by = bars.dominant();
  }
  if (!by) return {.reached = false, .words = "the accuracy asked for is not known to be reached: no bar says how"};
  std::string words;
  bool reached = by->relative <= by->asked;
  const std::optional<optimizer::Dominant> whole = whole_bar(problem, goal, evaluation, asked_history);
  if (reached && whole && whole->relative > whole->asked) {
    reached = false;
    words = fmt::format(
        "as far as settings buy it{} the accuracy asked for is reached; with all parts of its bar {} is known to "
        "{:.3g} % (asked: {:.3g} %), most of it by {}",
        problem.cases.empty() ? "" : fmt::format(" in case {}", problem.cases.front().name), whole->response,
        100 * whole->relative, 100 * whole->asked, whole->source);
  } else {
    words = fmt::format("the accuracy asked for is {}reached: {}", reached ? "" : "not ", known(*by));
  }
  std::vector<std::string> not_held = bars.not_held();
  add_unknown(problem, evaluation, not_held);
  if (!not_held.empty())
    words += fmt::format("; without a value or an error bar, and so held to none: {}", fmt::join(not_held, ", "));
  return {.reached = reached, .words = words, .not_held = not_held};
}

std::string round_words(const Study& study, const optimizer::SettingsTried& tried) {
  const optimizer::Scene there = optimizer::with_settings(study.scene, tried.settings);
  std::string text = fmt::format("{} edges per flank", there.mesh.flank_elements);
  if (optimizer::chooses_beside(study.scene, {}))
    text += fmt::format(", {:.2g} mm elements beside them", 1e3 * there.mesh.bulk_size);
  text += fmt::format(", {} harmonics, {} samples, {} modes: ", there.solver.harmonics, there.solver.samples,
                      there.solver.modes);
  if (tried.out_of_line) text += "out of line with most others, left out: ";
  return text + (tried.by ? known(*tried.by) : tried.status);
}

std::string taken_words(const Study& study, const optimizer::SettingsChoice& choice) {
  if (choice.rounds.size() < 2) return {};
  const bool cheaper =
      choice.tried.excess > 1 && std::ranges::any_of(choice.rounds, [&](const optimizer::SettingsTried& round) {
        return !round.out_of_line && round.excess < choice.tried.excess;
      });
  return "taken: " + round_words(study, choice.tried) +
         (cheaper ? "; hardly less accurate than the best of these, and cheaper" : "");
}

std::string accuracy_complaint(const Study& study, const optimizer::SettingsChoice& choice) {
  if (!choice.tried.by)
    return "no settings could be chosen: no response asked for has a value and an error bar at those to begin with";
  if (choice.status == Status::converged && !choice.not_held.empty())
    return fmt::format(
        "settings were chosen without {}: a value that is zero or missing, or has no error bar, has no "
        "relative accuracy",
        fmt::join(choice.not_held, ", "));
  if (choice.status == Status::converged) return {};
  std::vector<std::string> held;
  for (const std::string& key : study.given)
    if (study.scene.solver.accuracy > 0 && optimizer::buys_accuracy(study.scene, key)) held.push_back(key);
  std::string foreseen;
  if (choice.out_of_reach && std::isfinite(*choice.out_of_reach))
    foreseen = *choice.out_of_reach < 1.05
                   ? "; no settings are foreseen to leave less than what was asked"
                   : fmt::format("; no settings are foreseen to leave less than {:.3g} times what was asked",
                                 *choice.out_of_reach);
  if (choice.ran_idle) foreseen = "; the last rounds, at other settings, were no more accurate than those before";
  if (choice.work_refused)
    foreseen = fmt::format(
        "; the next settings would bring the work of choosing from {:.3g} to {:.3g} times that of an evaluation at "
        "those "
        "to begin with, of which solver.accuracy_work allows {:g}",
        choice.work, *choice.work_refused, study.scene.solver.accuracy_work);
  return fmt::format("the accuracy asked for is not reached: {}{}{}{}", known(*choice.tried.by), foreseen,
                     held.empty() ? "" : ". Given, and kept, are ", fmt::join(held, ", "));
}

}  // namespace dovetail::studies
