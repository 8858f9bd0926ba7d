#include "studies/report/words/report_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>

#include "contact/wear_law.hpp"
#include "optimizer/responses/response_table.hpp"
#include "optimizer/search/params.hpp"

namespace dovetail::report {

namespace {

double value_of(const std::map<std::string, double>& values, const std::string& name) {
  const auto found = values.find(name);
  return found == values.end() ? std::numeric_limits<double>::quiet_NaN() : found->second;
}

}  // namespace

const EvaluationRecord* baseline_of(const RunRecord& record) {
  return record.baseline && *record.baseline < record.evaluations.size() ? &record.evaluations[*record.baseline]
                                                                         : nullptr;
}

const EvaluationRecord* best_of(const RunRecord& record) {
  return record.best && *record.best < record.evaluations.size() ? &record.evaluations[*record.best] : nullptr;
}

double response(const EvaluationRecord& evaluation, const std::string& name) {
  return value_of(evaluation.responses, name);
}

double error_bar(const EvaluationRecord& evaluation, const std::string& name) {
  return value_of(evaluation.error_estimates, name);
}

Unit response_unit(const std::string& name, double largest) {
  if (name.ends_with("drift")) return {.symbol = "%", .si = 0.01};
  const optimizer::Response* known = optimizer::find_response(name);
  std::string si = known ? std::string(known->unit) : si_unit_of(name);
  if (!name.ends_with("_per_cycle")) return readable_unit(si, largest);
  si.resize(std::min(si.size(), si.find(" per cycle")));
  Unit unit = readable_unit(si, largest);
  unit.symbol += "/cycle";
  return unit;
}

std::string limit_words(const std::string& name, const optimizer::Problem& problem, bool with_number) {
  const std::size_t colon = name.rfind(':');
  const auto [response, over] = optimizer::split_case(std::string_view(name).substr(0, colon));
  const std::string limited(response), side = colon == std::string::npos ? "" : name.substr(colon + 1);
  std::string text = fmt::format("the {} limit of the {}{}", side, words(limited),
                                 over_words(problem, over.empty() ? to_string(optimizer::Over::worst) : over));
  if (!with_number) return text;
  for (const optimizer::ResponseConstraint& constraint : problem.constraints) {
    if (constraint.response != limited || (!over.empty() && constraint.over != over)) continue;
    const std::optional<double> limit = side == "upper" ? constraint.upper : constraint.lower;
    if (limit) text += " (" + plain(*limit, response_unit(limited, *limit)) + ")";
    break;
  }
  return text;
}

std::string constraint_words(const optimizer::Problem& problem, const std::string& name) {
  const std::size_t colon = name.rfind(':');
  const auto [response, over] = optimizer::split_case(std::string_view(name).substr(0, colon));
  return words(std::string(response)) + (over.empty() ? "" : over_words(problem, over)) +
         (colon == std::string::npos ? "" : ", " + name.substr(colon + 1));
}

std::string variable_value(const optimizer::DesignVariable& variable, double value) {
  return plain(std::abs(value) < 1e-9 * (variable.upper - variable.lower) ? 0 : value, 5);
}

std::string departure_words(const DepartureRecord& departure) {
  std::string text = departure.departure;
  if (text.ends_with(" um")) text.replace(text.size() - 3, 3, "\u00a0\u00b5m");
  if (const std::size_t minus = text.find(" -"); minus != std::string::npos) text.replace(minus, 2, " \u2212");
  return text;
}

std::string in_words(std::string text) {
  std::vector<std::string> names = optimizer::response_names();
  // Longer ones first: a name may be a part of another one.
  std::ranges::sort(names, std::ranges::greater(), &std::string::size);
  for (const std::string& name : names)
    for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + 1))
      text.replace(at, name.size(), "the " + words(name));
  return text;
}

std::string wear_words(const RunRecord& record) {
  const contact::WearLaw* law =
      record.wear_law.empty() ? contact::wear_laws().front() : contact::find_wear_law(record.wear_law);
  return law ? std::string(law->title) : "wear by the law " + record.wear_law;
}

std::string counted(std::size_t count, const std::string& what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

std::string over_words(const optimizer::Problem& problem, std::string_view over) {
  if (problem.cases.empty()) return "";
  const std::optional<optimizer::Over> rule = named<optimizer::Over>(over);
  if (!rule) return " in case " + std::string(over);
  switch (*rule) {
    case optimizer::Over::worst:
      return " in its worst case";
    case optimizer::Over::mean:
      return " averaged over the cases";
    case optimizer::Over::sum:
      return " summed over the cases";
    case optimizer::Over::deviation:
      return " as its deviation over the cases";
    case optimizer::Over::quantile:
      return fmt::format(" as {:g}\u00a0% quantile of the cases", 100 * problem.quantile);
  }
  return "";
}

optimizer::Barred shown_term(const optimizer::Problem& problem, const optimizer::ObjectiveTerm& term,
                             const EvaluationRecord& evaluation) {
  return as_response(term, term_value(problem, term, evaluation.responses, evaluation.error_estimates));
}

std::string best_word(const RunRecord& record) {
  return record.front ? "compromise" : "best";
}

std::string term_words(const optimizer::Problem& problem, const optimizer::ObjectiveTerm& term) {
  std::string text = words(term.response);
  if (term.absolute && term.target == 0) text = "size of the " + text;
  if (term.absolute && term.target != 0)
    text = "distance of the " + text + " from " + plain(term.target, response_unit(term.response, term.target));
  return text + over_words(problem, term.over);
}

std::string objective_words(const optimizer::Problem& problem) {
  std::vector<std::string> parts;
  for (const optimizer::ObjectiveTerm& term : problem.objective) parts.push_back(term_words(problem, term));
  if (parts.empty()) return "objective";
  if (problem.front) return "front of " + listed(parts);
  return parts.size() == 1 ? parts.front() : "weighted sum of " + listed(parts);
}

ObjectiveScale objective_scale(const RunRecord& record) {
  if (record.problem.objective.empty() || (record.problem.objective.size() > 1 && !record.problem.front)) return {};
  const optimizer::ObjectiveTerm& term = record.problem.objective.front();
  const double si = (term.scale > 0 ? term.scale : 1) / (term.weight != 0 ? term.weight : 1);
  double largest = 0;
  for (const EvaluationRecord& e : record.evaluations)
    if (std::isfinite(e.objective)) largest = std::max(largest, std::abs(e.objective * si));
  const Unit unit = response_unit(term.response, largest);
  return {.factor = si / unit.si, .unit = unit.symbol, .label = term_words(record.problem, term)};
}

bool keeps_all(const EvaluationRecord& evaluation) {
  return optimizer::converged(evaluation.status) &&
         std::ranges::all_of(evaluation.constraints, [](double c) { return c <= 0; }) &&
         std::ranges::all_of(evaluation.rules, [](const auto& rule) { return rule.second <= 0; });
}

std::string mesh_words(const FinerRecord& check) {
  return check.flank_elements > 0 ? fmt::format("with {} edges along each flank", check.flank_elements)
                                  : std::string("on a finer mesh");
}

std::vector<Holder> holding(const RunRecord& record) {
  constexpr double kNear = 0.005;
  // A search makes up for more than what a look changed in a limit that broke: so much of it may be left.
  constexpr double kLeft = 1.1 * (optimizer::CorrectionParams{}.more - 1);
  std::vector<Holder> found;
  const EvaluationRecord* best = best_of(record);
  if (!best) return found;
  const std::vector<std::string> names = constraint_names(record.problem);
  for (std::size_t i = 0; i < std::min(names.size(), best->constraints.size()); ++i) {
    const double here = best->constraints[i];
    const auto holds = [&](const FinerRecord& look) {
      if (look.evaluation != static_cast<std::int64_t>(*record.best) || i >= look.constraints.size()) return false;
      const double there = look.constraints[i];
      return there <= 0 && there > -kNear - kLeft * std::max(there - here, 0.0);
    };
    const auto there = std::ranges::find_if(record.finer, holds);
    if (here > -kNear)
      found.push_back({.what = limit_words(names[i], record.problem), .where = {}});
    else if (there != record.finer.end())
      found.push_back({.what = limit_words(names[i], record.problem), .where = mesh_words(*there)});
  }
  for (const auto& [name, c] : best->rules)
    if (c > -kNear && c != 0)
      found.push_back({.what = "the geometric rule \u201c" + words(name) + "\u201d", .where = {}});
  const std::vector<optimizer::DesignVariable>& variables = record.problem.space.variables();
  for (std::size_t i = 0; i < std::min(variables.size(), best->x.size()); ++i) {
    const std::string bound = at_bound(variables[i], best->x[i]);
    if (!bound.empty())
      found.push_back({.what = fmt::format("the {} bound of the {}", bound, key_words(variables[i].key)), .where = {}});
  }
  return found;
}

std::vector<std::string> without_bar(const RunRecord& record) {
  std::vector<std::string> found;
  const EvaluationRecord* best = best_of(record);
  if (!best || best->error_estimates.empty()) return found;
  const auto ask = [&](const std::string& response) {
    const std::string name = "the " + words(response);
    if (!best->error_estimates.contains(response) && std::ranges::find(found, name) == found.end())
      found.push_back(name);
  };
  for (const optimizer::ObjectiveTerm& term : record.problem.objective) ask(term.response);
  for (const optimizer::ResponseConstraint& limit : record.problem.constraints) ask(limit.response);
  return found;
}

std::string ending(const RunRecord& record) {
  std::size_t feasible = 0, failed = 0, refused = 0;
  for (const EvaluationRecord& e : record.evaluations) {
    feasible += e.feasible ? 1 : 0;
    refused += !e.feasible && keeps_all(e) ? 1 : 0;
    const optimizer::Outcome outcome = optimizer::outcome_of(e.status);
    failed += outcome != optimizer::Outcome::converged && outcome != optimizer::Outcome::infeasible ? 1 : 0;
  }
  const std::size_t all = record.evaluations.size();
  const std::optional<Status> status = named<Status>(record.status);
  const std::string why = record.message.empty() ? record.status : record.message;
  const std::string how =
      status == Status::interrupted ? "The run was interrupted; what follows is the state until then."
      : status == Status::converged
          ? "The search converged."
          : fmt::format("The search {}: {}{}", status == Status::iteration_limit ? "ended" : "stopped early", why,
                        why.ends_with(".") ? "" : ".");
  const std::string finer = refused == 0 || record.finer.empty()
                                ? ""
                                : fmt::format(", of them {} on finer meshes alone or by what these change", refused);
  return fmt::format("{} It looked at {}: {} feasible, {} breaking a limit or a geometric rule{}, {} not computed.",
                     how, counted(static_cast<std::size_t>(all), "candidate"), feasible, all - feasible - failed, finer,
                     failed);
}

std::string at_bound(const optimizer::DesignVariable& variable, double value) {
  const double near = 0.005 * (variable.upper - variable.lower);
  if (value <= variable.lower + near) return "lower";
  return value >= variable.upper - near ? "upper" : "";
}

std::string listed(const std::vector<std::string>& items) {
  std::string text;
  for (std::size_t i = 0; i < items.size(); ++i)
    text += (i == 0 ? "" : i + 1 == items.size() ? " and " : ", ") + items[i];
  return text;
}

}  // namespace dovetail::report
