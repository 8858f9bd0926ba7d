// Commands that read or write study files and compute nothing, or one candidate.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>
#include <ostream>
#include <set>
#include <string>
#include <utility>

#include "core/replace_file.hpp"
#include "optimizer/cases.hpp"
#include "optimizer/evaluation_cost.hpp"
#include "optimizer/problem/problem.hpp"
#include "optimizer/responses/response_table.hpp"
#include "optimizer/scene/scene_kind.hpp"
#include "reduction/model_file.hpp"
#include "studies/program/answers/accuracy_json.hpp"
#include "studies/program/answers/dakota.hpp"
#include "studies/program/answers/json.hpp"
#include "studies/program/answers/schema.hpp"
#include "studies/program/answers/teller.hpp"
#include "studies/program/answers/version.hpp"
#include "studies/program/commands/commands.hpp"
#include "studies/program/engine/engine.hpp"
#include "studies/program/engine/interrupt.hpp"
#include "studies/program/engine/loaded_model.hpp"
#include "studies/program/engine/run_folder.hpp"
#include "studies/program/engine/settled_study.hpp"
#include "studies/program/study_file/materials.hpp"
#include "studies/program/study_file/refusal.hpp"
#include "studies/program/study_file/study_template.hpp"

namespace dovetail::studies {

namespace {

/// What the model of a study takes, s, where anybody sees it: nearly all of an evaluation of one case without bars.
double model_seconds(const Study& study, const Teller& teller) {
  if (!teller.shows()) return 0;
  return expected_cost(study).seconds / static_cast<double>(std::max<std::size_t>(study.problem.cases.size(), 1));
}

}  // namespace

void deliver_json(const std::string& where, const std::string& text, const Streams& streams) {
  if (where.empty()) return;
  if (where != "-") return replace_file(where, text);
  streams.out << text << std::flush;
  if (!streams.out) refuse("standard output", "cannot be written");
}

LoadedModel told_model(const std::string& input, const std::vector<std::string>& set, const SolverChoice& solver,
                       Teller& teller, std::optional<wear::Follow> follow) {
  teller.begin("reading the input");
  return load_model(input, set, solver, &teller.remark(), follow,
                    [&](const Study& study) { teller.begin("the reduced model", model_seconds(study, teller)); });
}

LoadedModel told_model(const Study& study, Teller& teller, std::optional<wear::Follow> follow) {
  teller.begin("the reduced model", model_seconds(study, teller));
  return load_model(study, &teller.remark(), follow);
}

int interrupted(const std::string& kept, const Streams& streams) {
  streams.err << "dovetail: interrupted; the answer has " << kept << "\n";
  return kInterrupted;
}

int not_converged(const std::string& input, const std::string& what, const Streams& streams) {
  streams.err << "dovetail: " << input << ": " << what << "\n";
  return kNotConverged;
}

int run_new(const NewOptions& options, const Streams& streams) {
  const std::filesystem::path file(options.file);
  std::error_code ignored;
  if (std::filesystem::exists(file, ignored)) refuse(options.file, "exists already; choose another name");
  std::string title = file.stem().string();
  for (char& c : title)
    if (c == '"' || c == '\\' || static_cast<unsigned char>(c) < 0x20) c = ' ';
  replace_file(file, study_template(title, options.kind));
  streams.out << fmt::format("{}: written; try `dovetail evaluate {}`\n", options.file, options.file);
  return kDone;
}

int run_schema(const SchemaOptions& options, const Streams& streams) {
  streams.out << (options.of == SchemaOf::study      ? study_schema()
                  : options.of == SchemaOf::evaluate ? evaluation_schema()
                  : options.of == SchemaOf::runs     ? runs_schema()
                                                     : materials_schema());
  return kDone;
}

int run_materials(const MaterialsOptions& options, const Streams& streams) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  std::string table = fmt::format("{:<22}{:>8}{:>8}{:>10}   at 20 C\n", "", "E GPa", "nu", "kg/m3");
  for (const NamedMaterial& one : named_materials()) {
    nlohmann::ordered_json entry{{"name", one.name}};
    for (const Field<fem::Material>& field : option_table<fem::Material>())
      entry[std::string(field.key)] = one.at_20_c.*std::get<double fem::Material::*>(field.member) / field.si_per_unit;
    entry["source"] = one.source;
    list.push_back(std::move(entry));
    table += fmt::format("{:<22}{:>8.4g}{:>8.4g}{:>10.4g}   {}\n", one.name, one.at_20_c.youngs_modulus / 1e9,
                         one.at_20_c.poisson_ratio, one.at_20_c.density, one.source);
  }
  if (options.json != "-") streams.out << table;
  const nlohmann::ordered_json answer{{"version", kAnswerVersion}, {"materials", list}};
  deliver_json(options.json, answer.dump(2) + "\n", streams);
  return kDone;
}

namespace {

/// What the error bar of a constraint's response says of it, where that leaves it open.
const char* sureness(const optimizer::Evaluation& evaluation, const std::string& constraint) {
  if (std::ranges::count(evaluation.undecided_constraints, constraint) == 0) return "";
  const bool none = std::ranges::any_of(evaluation.unbounded,
                                        [&](const std::string& name) { return constraint.starts_with(name + ":"); });
  return none ? "  its response has no error bar" : "  within its error bar";
}

/// The responses that objective and limits name, case by case, and what the objective is over all.
std::string case_table(const optimizer::Problem& problem, const optimizer::Evaluation& evaluation) {
  std::string text;
  for (const optimizer::LoadCase& load : problem.cases) {
    text += fmt::format("\ncase {}\n", load.name);
    for (const std::string& name : optimizer::responses_of(problem)) {
      const std::string here = optimizer::of_case(name, load.name);
      const auto value = evaluation.responses.find(here);
      if (value == evaluation.responses.end()) continue;
      text += fmt::format("  {:<30} {:>14.7g}", name, value->second);
      const auto error = evaluation.error_estimates.find(here);
      if (error != evaluation.error_estimates.end()) text += fmt::format(" +- {:.2g}", error->second);
      const optimizer::Response* response = optimizer::find_response(name);
      text += response->unit.empty() ? "\n" : fmt::format(" {}\n", response->unit);
    }
  }
  if (problem.cases.empty() || problem.objective.empty() || !evaluation.converged()) return text;
  text += "\nobjective\n";
  for (const optimizer::ObjectiveTerm& term : problem.objective) {
    const auto [value, bar] =
        as_response(term, term_value(problem, term, evaluation.responses, evaluation.error_estimates));
    text += fmt::format("  {:<30} {:>14.7g}{} {}\n", term.response + ", " + term.over, value,
                        std::isfinite(bar) ? fmt::format(" +- {:.2g}", bar) : "",
                        optimizer::find_response(term.response)->unit);
  }
  return text;
}

std::string evaluation_table(const optimizer::Problem& problem, const optimizer::Evaluation& evaluation) {
  std::string text = fmt::format("status    {}\nfeasible  {}", evaluation.status, evaluation.feasible ? "yes" : "no");
  const auto& undecided = evaluation.undecided_constraints;
  const bool all =
      std::ranges::all_of(undecided, [&](const auto& name) { return evaluation.constraints.contains(name); });
  text += all ? "\n" : ", as far as limits are judged\n";
  for (const auto& [name, value] : evaluation.constraints)
    if (value > 0 && !name.starts_with(optimizer::kRulePrefix))
      text += fmt::format("breaks    {} by {:.3g} % of its limit\n", name, 100 * value);
  if (!evaluation.responses.empty())
    text +=
        problem.cases.empty() ? "\nresponses\n" : fmt::format("\nresponses in case {}\n", problem.cases.front().name);
  for (const std::string& name : optimizer::response_names()) {
    const auto value = evaluation.responses.find(name);
    if (value == evaluation.responses.end()) continue;
    const optimizer::Response& response = *optimizer::find_response(name);
    text += fmt::format("  {:<30} {:>14.7g}", name, value->second);
    const auto error = evaluation.error_estimates.find(value->first);
    if (error != evaluation.error_estimates.end()) text += fmt::format(" +- {:.2g}", error->second);
    if (!response.unit.empty()) text += fmt::format(" {}", response.unit);
    text += "\n";
  }
  const char* heading = "\nconstraints, satisfied when <= 0\n";
  for (const auto& [name, value] : evaluation.constraints)
    if (!name.starts_with(optimizer::kRulePrefix) || value > 0)
      text +=
          std::exchange(heading, "") + fmt::format("  {:<44} {:>12.5g}{}\n", name, value, sureness(evaluation, name));
  for (const std::string& name : evaluation.unbounded) text += fmt::format("\n{} has no error bar", name);
  return evaluation.unbounded.empty() ? text : text + "\n";
}

/// Leaves out what an evaluation without wear has no answer for, and says so.
/// @return the names of the limits left out
std::vector<std::string> keep_unworn(optimizer::Problem& problem, optimizer::Evaluation& evaluation) {
  std::vector<std::string> unjudged = optimizer::constraint_names(problem);
  std::set<std::string> left;
  const auto missing = [&](const auto& term) {
    if (evaluation.responses.contains(term.response)) return false;
    left.insert(term.response);
    return true;
  };
  std::erase_if(problem.objective, missing);
  std::erase_if(problem.constraints, missing);
  if (!left.empty())
    evaluation.messages.push_back(
        fmt::format("Without wear nothing is said of {}, nor of limits on it.", fmt::join(left, ", ")));
  const std::vector<std::string> judged = optimizer::constraint_names(problem);
  std::erase_if(unjudged, [&](const std::string& name) { return std::ranges::count(judged, name) > 0; });
  return unjudged;
}

/// Whether the round of a choice whose settings are taken is the evaluation asked for: with --no-history. One that may
/// ask a history looks for doubts of worn states more closely than rounds do.
bool answers(const optimizer::SettingsChoice& choice, const optimizer::AccuracyGoal& goal,
             const optimizer::Purpose& purpose) {
  if (!choice.tried.by || goal.of_truncation || !purpose.bars) return false;
  const bool as_far = goal.responses.empty() || optimizer::last_stage(goal.responses) == purpose.until;
  return as_far && !purpose.history;
}

/// Dakota takes it as a design that failed; no older answer may stand for it.
void fail_dakota(const std::string& results, const InputError& error) {
  replace_file(results, "fail: " + one_line(error.what()) + "\n");
}

/// Two ways to choose the same.
void refuse_automatic(const SolverChoice& solver) {
  std::vector<Violation> found;
  for (const SolverKey& key : solver_keys())
    if (key.automatic && solver.*key.member == kAutomatic)
      found.push_back({.file = {},
                       .key = key.option() + " " + std::string(kAutomatic),
                       .value = {},
                       .allowed = "must not be given beside solver.accuracy, which chooses it"});
  refuse(std::move(found));
}

}  // namespace

int run_evaluate(const EvaluateOptions& options, Teller& teller, const Streams& streams) {
  std::vector<std::string> set = options.set;
  std::optional<DakotaQuestion> dakota;
  if (!options.dakota.empty()) {
    check_replaceable(options.dakota.back());
    try {
      dakota = read_dakota(options.dakota.front());
    } catch (const InputError& error) {
      fail_dakota(options.dakota.back(), error);
      throw;
    }
    set.insert(set.end(), dakota->set.begin(), dakota->set.end());
    // Dakota takes it as a design that failed, and nothing needs to be computed.
    if (dakota->asks_for_derivatives()) {
      replace_file(options.dakota.back(), dakota_results(*dakota, {}, {}));
      return not_converged(options.dakota.front(), "derivatives are asked for, and there are none", streams);
    }
  }
  Study study;
  try {
    study = load_study(study_or_best(options.study, &teller.remark()), overrides(set, options.solver));
  } catch (const InputError& error) {
    if (dakota) fail_dakota(options.dakota.back(), error);
    throw;
  }
  for (const std::string& warning : warnings(study))
    teller.remark() << options.study << ": warning: " << warning << "\n";
  if (study.scene.solver.accuracy > 0) refuse_automatic(options.solver);
  const Study asked = study;
  const optimizer::Stage until = options.unworn ? optimizer::Stage::unworn : optimizer::Stage::worn_resonance;
  std::optional<optimizer::AccuracyGoal> goal =
      study.scene.solver.accuracy > 0 ? accuracy_goal(study, until) : truncation_goal(study, options.solver, until);
  if (goal) goal->many = false;
  if (asked.scene.solver.accuracy > 0 && !goal)
    teller.remark()
        << options.study
        << ": warning: solver.accuracy chooses nothing here: with --unworn none of the responses that objective "
           "and constraints name is computed\n";
  if (goal) teller.begin("choosing settings");
  const std::optional<optimizer::SettingsChoice> choice =
      settle(study, goal, [&](const optimizer::SettingsTried& tried) {
        teller.remark() << "dovetail: " << round_words(asked, tried) << "\n";
        return true;
      });
  const optimizer::Purpose purpose{
      .bars = !options.no_bars && !options.unworn, .history = !options.no_history, .until = until};
  const std::vector<optimizer::MissionCases> missions =
      options.unworn ? std::vector<optimizer::MissionCases>() : study_missions(study, true);
  const auto computed = [&] {
    const double work = optimizer::work_foreseen(study.scene.kind->in_space).bars;
    teller.begin("computing the design", teller.shows() ? (purpose.bars ? work : 1) * expected_cost(study).seconds : 0);
    const auto evaluator = scene_evaluator(study);
    return optimizer::evaluated_in_cases(
        study.problem.cases, study.scene,
        [&](const optimizer::Scene& scene, std::size_t) { return evaluator->evaluate(scene, purpose).evaluation; },
        missions,
        [&](const optimizer::MissionCases& mission, std::size_t) {
          return evaluator->evaluate_mission(optimizer::mission_loads(study.scene, study.problem.cases, mission),
                                             purpose);
        });
  };
  const bool one_case = study.problem.cases.empty() && missions.empty();
  optimizer::Evaluation evaluation =
      choice && one_case && answers(*choice, *goal, purpose) ? choice->evaluation : computed();
  teller.end();
  if (choice) optimizer::raise_bars(choice->raised, evaluation);
  std::string inaccurate = choice ? accuracy_complaint(asked, *choice) : std::string();
  // A history may end elsewhere than where the rounds were; where bars were not asked for the rounds have some.
  const bool judged = choice && choice->status == Status::converged && !goal->of_truncation && evaluation.converged();
  const AccuracyHeld held =
      !judged ? AccuracyHeld{.reached = true}
              : accuracy_held(study.problem, study.scene, *goal, purpose.bars ? evaluation : choice->evaluation,
                              purpose.bars && purpose.history);
  if (!held.reached) inaccurate = held.words;
  if (choice)
    for (const std::string& words : {taken_words(asked, *choice), digit_words(*choice)})
      if (!words.empty()) teller.remark() << "dovetail: " << words << "\n";
  if (!inaccurate.empty() && !evaluation.infeasible()) evaluation.messages.push_back(inaccurate);
  const std::optional<optimizer::Dominant> whole =
      choice && !goal->of_truncation ? whole_bar(study.problem, *goal, evaluation, purpose.history) : std::nullopt;
  std::vector<std::string> unjudged;
  if (options.unworn && evaluation.converged()) unjudged = keep_unworn(study.problem, evaluation);
  optimizer::annotate(study.problem, study.optimizer.constraint_tolerance, evaluation);
  std::ranges::move(unjudged, std::back_inserter(evaluation.undecided_constraints));
  nlohmann::ordered_json accuracy = choice ? accuracy_json(asked.scene, *choice) : nlohmann::ordered_json();
  // With all parts of the bars, where there are some.
  if (whole && evaluation.converged())
    accuracy["reached"] = choice->status == Status::converged && held.reached && choice->not_held.empty() &&
                          held.not_held.empty() && whole->relative <= whole->asked;
  if (whole)
    accuracy["whole_bar"] = {{"response", whole->response},
                             {"source", whole->source},
                             {"relative_bar", whole->relative},
                             {"asked", whole->asked}};
  deliver_json(options.json, evaluation_json(evaluation, choice ? &accuracy : nullptr, &study.problem), streams);
  if (dakota) replace_file(options.dakota.back(), dakota_results(*dakota, evaluation, study.problem));
  if (options.json != "-")
    streams.out << evaluation_table(study.problem, evaluation) << case_table(study.problem, evaluation);
  if (evaluation.infeasible()) throw infeasible(options.study, evaluation.messages);
  for (const std::string& message : evaluation.messages) teller.remark() << "dovetail: " << message << "\n";
  if (evaluation.converged())
    return choice && (choice->status != Status::converged || !held.reached) ? kNotConverged : kDone;
  const auto ends_in = [&](auto why) { return evaluation.status.ends_with(to_string(why)); };
  const char* what = ends_in(wear::Verdict::no_asymptote) ? "wear has no end"
                     : ends_in(Status::gross_sliding)     ? "the joint slides"
                                                          : "not converged";
  return not_converged(options.study, fmt::format("{}: {}", what, evaluation.status), streams);
}

int run_reduce(const ReduceOptions& options, Teller& teller, const Streams& streams) {
  const LoadedModel loaded = told_model(options.study, options.set, {}, teller);
  teller.end();
  if (!loaded.failure.empty()) return not_converged(options.study, "not converged: " + loaded.failure, streams);
  reduction::write_model(options.model, loaded.model);
  streams.out << fmt::format("{}: {} coordinates, {} contact nodes\n", options.model, loaded.model.size(),
                             loaded.model.contact.count());
  return kDone;
}

}  // namespace dovetail::studies
