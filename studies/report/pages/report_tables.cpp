#include "studies/report/pages/report_tables.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>

#include "optimizer/responses/response_table.hpp"
#include "studies/report/plots/plot.hpp"
#include "studies/report/words/report_words.hpp"
#include "studies/report/words/table.hpp"

namespace dovetail::report {

namespace {

/// Responses the two evaluations have: those of the table in its order, then others.
std::vector<std::string> names_of(const EvaluationRecord* first, const EvaluationRecord* second) {
  const auto known = [&](const std::string& name) {
    return (first && first->responses.count(name) > 0) || (second && second->responses.count(name) > 0);
  };
  std::vector<std::string> names;
  for (const std::string& name : optimizer::response_names())
    if (known(name)) names.push_back(name);
  for (const EvaluationRecord* evaluation : {first, second}) {
    if (!evaluation) continue;
    for (const auto& [name, value] : evaluation->responses)
      if (optimizer::split_case(name).load_case.empty() && std::ranges::find(names, name) == names.end())
        names.push_back(name);
  }
  return names;
}

Cell shown_response(const EvaluationRecord* evaluation, const std::string& name, const Unit& unit) {
  const double value = evaluation ? response(*evaluation, name) : std::numeric_limits<double>::quiet_NaN();
  if (std::isnan(value)) return "\u2013";
  const bool open = !evaluation->error_estimates.empty() && !evaluation->error_estimates.contains(name);
  return Html{with_error(value, error_bar(*evaluation, name), unit) +
              (open ? " <span class=\"soft\">without a bar</span>" : "")};
}

/// With "within error" where it is.
Cell change(const EvaluationRecord& from, const EvaluationRecord& to, const std::string& name, const Unit& unit) {
  const double a = response(from, name), b = response(to, name), bars = error_bar(from, name) + error_bar(to, name);
  const std::string text = difference(a, b, unit);
  const bool told = text != "none" && bars > 0 && std::abs(b - a) <= bars;
  return Html{told ? text + " <span class=\"soft\">within error</span>" : text};
}

/// A value of a variable; what is nothing beside its range is 0.
std::string variable_value(const optimizer::DesignVariable& variable, double value) {
  return plain(std::abs(value) < 1e-9 * (variable.upper - variable.lower) ? 0 : value, 5);
}

/// "peak_amplitude_m:upper" -> "peak amplitude, upper"
std::string constraint_words(const optimizer::Problem& problem, const std::string& name) {
  const std::size_t colon = name.rfind(':');
  const auto [response, over] = optimizer::split_case(std::string_view(name).substr(0, colon));
  return words(std::string(response)) + (over.empty() ? "" : over_words(problem, over)) +
         (colon == std::string::npos ? "" : ", " + name.substr(colon + 1));
}

std::string help_of(const std::string& name) {
  const optimizer::Response* known = optimizer::find_response(name);
  return known ? std::string(known->help) : name;
}

bool is_objective(const RunRecord& record, const std::string& name) {
  return std::any_of(record.problem.objective.begin(), record.problem.objective.end(),
                     [&](const optimizer::ObjectiveTerm& term) { return term.response == name; });
}

bool has_both(const EvaluationRecord* base, const EvaluationRecord* best) {
  return base && best && base != best;
}

/// @param word  for the best one
void add_headings(const EvaluationRecord* base, const EvaluationRecord* best, const std::string& word, Table& table) {
  for (const std::string& heading : has_both(base, best)
                                        ? std::vector<std::string>{"before (start)", "after (" + word + ")", "change"}
                                        : std::vector<std::string>{best ? word + " (the start)" : "start"})
    table.columns.push_back({heading});
}

/// A response of start and best design, or of the only one there is.
Row figures_row(std::vector<Cell> head, const EvaluationRecord* base, const EvaluationRecord* best,
                const std::string& name, const char* style = "") {
  const double largest =
      std::max(base ? std::abs(response(*base, name)) : 0, best ? std::abs(response(*best, name)) : 0);
  const Unit unit = response_unit(std::string(optimizer::split_case(name).response), largest);
  Row row{.cells = std::move(head), .style = style};
  if (has_both(base, best))
    row.cells.insert(row.cells.end(), {shown_response(base, name, unit), shown_response(best, name, unit),
                                       change(*base, *best, name, unit)});
  else
    row.cells.push_back(shown_response(best ? best : base, name, unit));
  return row;
}

}  // namespace

std::string key_figures(const RunRecord& record) {
  const EvaluationRecord* base = baseline_of(record);
  const EvaluationRecord* best = best_of(record);
  const bool both = has_both(base, best);
  const std::vector<std::string> names = names_of(base, best);
  if (names.empty()) return "<p>Neither the start nor any other design could be evaluated in full.</p>\n";
  Table table{.columns = {{""}}, .rows = {}, .style = both ? "figures pair" : "figures"};
  add_headings(base, best, best_word(record), table);
  for (const std::string& name : names)
    table.rows.push_back(
        figures_row({titled(words(name), help_of(name))}, base, best, name, is_objective(record, name) ? "aim" : ""));
  return table_html(table);
}

namespace {

/// What a case changes, in words.
std::string change_words(const optimizer::KeyChange& change) {
  const std::string unit = key_unit(change.key);
  std::string words = key_words(change.key);
  if (change.times != 0 && change.times != 1) words += " times " + plain(change.times, 4);
  if (change.times != 0 && change.value != 0) words += change.value > 0 ? " plus" : " minus";
  if (change.times == 0 || change.value != 0)
    words += " " + plain(change.times == 0 ? change.value : std::abs(change.value), 4) +
             (unit.empty() ? "" : "\u00a0" + unit);
  return words;
}

/// Cases, or the samples of one case.
struct Group {
  std::string name;
  std::vector<const optimizer::LoadCase*> members;
};

std::vector<Group> groups_of(const optimizer::Problem& problem) {
  std::vector<Group> groups;
  for (const optimizer::LoadCase& load : problem.cases) {
    const std::string& name = load.sample_of.empty() ? load.name : load.sample_of;
    if (groups.empty() || groups.back().name != name) groups.push_back({.name = name, .members = {}});
    groups.back().members.push_back(&load);
  }
  return groups;
}

/// The range of a response over the samples of a group.
Cell range_over(const EvaluationRecord* evaluation, const std::string& name, const Group& group, const Unit& unit) {
  double least = std::numeric_limits<double>::infinity(), largest = -least;
  for (const optimizer::LoadCase* load : group.members) {
    const double value = evaluation ? response(*evaluation, optimizer::of_case(name, load->name)) : std::nan("");
    if (!std::isfinite(value)) return "\u2013";
    least = std::min(least, value);
    largest = std::max(largest, value);
  }
  return Html{significant(least / unit.si, 3) + " to " + plain(largest, unit)};
}

}  // namespace

std::string case_list(const RunRecord& record) {
  if (record.problem.cases.empty()) return {};
  std::string text = "<ul>\n";
  double all = 0;
  for (const optimizer::LoadCase& load : record.problem.cases) all += load.weight;
  for (const Group& group : groups_of(record.problem)) {
    double weight = 0;
    std::vector<std::string> changes;
    for (const optimizer::LoadCase* load : group.members) weight += load->weight;
    if (group.members.size() == 1)
      for (const optimizer::KeyChange& change : group.members.front()->changes) changes.push_back(change_words(change));
    else
      changes.push_back(fmt::format("{} samples of what is not known", group.members.size()));
    text += fmt::format("<li><b>{}</b>, {} % of the life: {}</li>\n", escape(group.name),
                        significant(100 * weight / all, 3),
                        changes.empty() ? "as the study says" : escape(listed(changes)));
  }
  return text + "</ul>\n";
}

std::string case_table(const RunRecord& record) {
  const EvaluationRecord* base = baseline_of(record);
  const EvaluationRecord* best = best_of(record);
  if (record.problem.cases.empty() || (!base && !best)) return {};
  Table table{.columns = {{"case", true}, {"", true}}, .rows = {}};
  add_headings(base, best, best_word(record), table);
  for (const std::string& name : optimizer::responses_of(record.problem))
    for (const Group& group : groups_of(record.problem)) {
      if (group.members.size() == 1) {
        table.rows.push_back(figures_row({group.name, words(name)}, base, best, optimizer::of_case(name, group.name)));
        continue;
      }
      const EvaluationRecord* only = best ? best : base;
      const Unit unit = response_unit(name, response(*only, name));
      Row row{.cells = {group.name, words(name)}};
      if (has_both(base, best)) row.cells.push_back(range_over(base, name, group, unit));
      row.cells.push_back(range_over(only, name, group, unit));
      if (has_both(base, best)) row.cells.emplace_back("");
      table.rows.push_back(std::move(row));
    }
  return fmt::format("<p>The figures above are of the first case, {}.</p>\n",
                     escape(record.problem.cases.front().name)) +
         table_html(table);
}

std::string variable_table(const RunRecord& record) {
  const EvaluationRecord* best = best_of(record);
  Table table{.columns = {{""}, {"unit"}, {"lower"}, {"upper"}, {"start"}, {best_word(record)}, {""}, {"key", true}},
              .rows = {}};
  const std::vector<optimizer::DesignVariable>& variables = record.problem.space.variables();
  for (std::size_t i = 0; i < variables.size(); ++i) {
    const optimizer::DesignVariable& v = variables[i];
    const bool known = best && i < best->x.size();
    const std::string bound = known ? at_bound(v, best->x[i]) : "";
    table.rows.push_back({{key_words(v.key), key_unit(v.key), plain(v.lower), plain(v.upper), plain(v.start),
                           Html{"<b>" + (known ? variable_value(v, best->x[i]) : "\u2013") + "</b>"},
                           Html{bound.empty() ? "" : "<span class=\"flag\">at " + bound + " bound</span>"},
                           Html{"<code>" + escape(v.key) + "</code>"}}});
  }
  const auto number = [](const std::optional<DesignRecord>& design, const std::string& key) -> std::string {
    if (!design || !design->parameters.contains(key)) return "\u2013";
    return plain(design->parameters.at(key), 5);
  };
  for (const auto& [key, formula] : record.provenance.linked)
    table.rows.push_back({{key_words(key), key_unit(key), "", "", number(record.baseline_design, key),
                           Html{"<b>" + number(record.best_design, key) + "</b>"},
                           Html{"= <code>" + escape(formula) + "</code>"}, Html{"<code>" + escape(key) + "</code>"}}});
  return table_html(table);
}

std::string problem_list(const RunRecord& record) {
  std::string text = "<ul>\n";
  for (const optimizer::ObjectiveTerm& term : record.problem.objective) {
    text += fmt::format("<li>{} the {}", term.weight < 0 ? "Maximise" : "Minimise",
                        escape(term_words(record.problem, term)));
    if (record.front) {
      const double reference =
          record.front->reference[static_cast<std::size_t>(&term - record.problem.objective.data())];
      text += ", each for itself; beyond " + plain(reference, response_unit(term.response, reference)) +
              " a design counts nothing for the hypervolume";
    } else if (record.problem.objective.size() > 1 && !record.problem.front) {
      const Unit unit = response_unit(term.response, term.scale);
      text += fmt::format(", weight {}, scale {}", plain(std::abs(term.weight)), plain(term.scale, unit));
    }
    text += "</li>\n";
  }
  for (const optimizer::ResponseConstraint& c : record.problem.constraints) {
    const Unit unit = response_unit(c.response, std::max(std::abs(c.lower.value_or(0)), std::abs(c.upper.value_or(0))));
    text += "<li>Keep the " + escape(words(c.response) + over_words(record.problem, c.over)) +
            (c.absolute ? " (magnitude)" : "");
    if (c.lower) text += " at least " + plain(*c.lower, unit);
    if (c.upper) text += std::string(c.lower ? " and" : "") + " at most " + plain(*c.upper, unit);
    text += "</li>\n";
  }
  return text + "</ul>\n";
}

std::string limit_table(const RunRecord& record) {
  const EvaluationRecord* best = best_of(record);
  std::vector<const FinerRecord*> finer;
  for (const FinerRecord& check : record.finer)
    if (record.best && check.evaluation == static_cast<std::int64_t>(*record.best)) finer.push_back(&check);
  const std::vector<std::string> names = constraint_names(record.problem);
  if (best == nullptr || finer.empty() || best->constraints.size() != names.size()) return {};
  Table table{.columns = {{"limit", true}, {"room left (%)"}}, .rows = {}};
  for (const FinerRecord* check : finer)
    table.columns.push_back({fmt::format("on {} edges (%)", check->flank_elements)});
  const optimizer::JudgementBars bars = judgement_bars(record.problem, best->responses, best->error_estimates);
  for (std::size_t j = 0; j < names.size(); ++j) {
    const double bar = bars.constraints[j];
    const auto undecided = [bar](double constraint) { return std::abs(constraint) < bar ? " undecided" : ""; };
    Row row{{constraint_words(record.problem, names[j]),
             with_error(-best->constraints[j], bar, {.symbol = "", .si = 0.01}) + undecided(best->constraints[j])}};
    for (const FinerRecord* check : finer)
      row.cells.emplace_back(j < check->constraints.size() && std::isfinite(check->constraints[j])
                                 ? significant(-100 * check->constraints[j], 3) + undecided(check->constraints[j])
                                 : check->status);
    table.rows.push_back(std::move(row));
  }
  return table_html(table);
}

namespace {

/// Whether a design keeps its limits there, and which one it breaks most.
std::string limits_there(const RunRecord& record, const DepartureRecord& there) {
  if (!optimizer::converged(there.status)) return there.status;
  const auto worst = std::ranges::max_element(there.constraints);
  if (worst == there.constraints.end()) return "no limits";
  if (*worst <= 0) return fmt::format("kept by {}\u00a0% or more", significant(-100 * *worst, 2));
  const auto index = static_cast<std::size_t>(worst - there.constraints.begin());
  return fmt::format("{} broken by {}\u00a0%",
                     constraint_words(record.problem, constraint_names(record.problem)[index]),
                     significant(100 * *worst, 2));
}

}  // namespace

std::string departure_table(const RunRecord& record) {
  if (record.departures.empty() || !record.best) return {};
  const ObjectiveScale objective = objective_scale(record);
  const bool both = record.best != record.baseline;
  Table table{.columns = {{"", true}}, .rows = {}};
  for (const std::string& whose :
       both ? std::vector<std::string>{"start", best_word(record)} : std::vector{best_word(record)})
    table.columns.insert(table.columns.end(),
                         {{PlotAxis{.label = whose, .unit = objective.unit}.title()}, {"its limits", true}});
  std::size_t holds = 0, better = 0, all = 0;
  for (const DepartureRecord& best : record.departures) {
    if (best.evaluation != static_cast<std::int64_t>(*record.best)) continue;
    Row row{{best.departure}};
    const auto add = [&](const DepartureRecord& there) {
      row.cells.emplace_back(std::isfinite(there.objective) ? significant(there.objective * objective.factor, 3)
                                                            : "\u2013");
      row.cells.emplace_back(limits_there(record, there));
    };
    const DepartureRecord* start = nullptr;
    for (const DepartureRecord& other : record.departures)
      if (other.evaluation == 0 && other.departure == best.departure) start = &other;
    if (both && start != nullptr) add(*start);
    if (both && start == nullptr) row.cells.insert(row.cells.end(), {"\u2013", "\u2013"});
    add(best);
    ++all;
    better += start != nullptr && best.objective < start->objective ? 1 : 0;
    holds += optimizer::converged(best.status) && std::ranges::all_of(best.constraints, [](double c) { return c <= 0; })
                 ? 1
                 : 0;
    table.rows.push_back(std::move(row));
  }
  std::string text = fmt::format("The best design keeps its limits in {} of {} of these", holds, all);
  if (both)
    text += record.front ? fmt::format(" and has a better {} than the start in {}", escape(objective.label), better)
                         : fmt::format(" and is better than the start in {}", better);
  return "<p>" + text + ". The " + escape(objective.label) +
         " of each is computed by itself, without error bars.</p>\n" + table_html(table);
}

std::string evaluation_table(const RunRecord& record) {
  const std::vector<optimizer::DesignVariable>& variables = record.problem.space.variables();
  const ObjectiveScale objective = objective_scale(record);
  Table table{.columns = {{"#"},
                          {"found by", true},
                          {"status", true},
                          {PlotAxis{.label = objective.label, .unit = objective.unit}.title()}},
              .rows = {},
              .named_rows = false};
  const std::size_t others = record.front ? record.front->columns() : 1;
  std::vector<Unit> units;
  for (std::size_t k = 1; k < others; ++k) {
    const optimizer::ObjectiveTerm& term = record.problem.objective[k];
    units.push_back(response_unit(term.response, record.front->reference[k]));
    table.columns.push_back({PlotAxis{.label = term_words(record.problem, term), .unit = units.back().symbol}.title()});
  }
  for (const std::string& name : constraint_names(record.problem))
    table.columns.push_back({constraint_words(record.problem, name)});
  for (const optimizer::DesignVariable& v : variables)
    table.columns.push_back({PlotAxis{.label = key_words(v.key), .unit = key_unit(v.key)}.title()});
  for (std::size_t i = 0; i < record.evaluations.size(); ++i) {
    const EvaluationRecord& e = record.evaluations[i];
    const std::string status = !optimizer::converged(e.status) ? e.status : e.feasible ? "feasible" : "breaks a limit";
    Row row{.cells = {std::to_string(i + 1), e.phase, titled(status, fmt::format("{}", fmt::join(e.messages, " "))),
                      significant(objective.factor * e.objective, 4)},
            .style = record.best == i ? "aim"
                     : e.feasible     ? ""
                                      : "soft"};
    for (std::size_t k = 1; k < others; ++k)
      row.cells.emplace_back(
          significant(shown_term(record.problem, record.problem.objective[k], e).value / units[k - 1].si, 4));
    for (const double c : e.constraints) row.cells.emplace_back(significant(c, 3));
    for (std::size_t k = 0; k < std::min(variables.size(), e.x.size()); ++k)
      row.cells.emplace_back(variable_value(variables[k], e.x[k]));
    table.rows.push_back(std::move(row));
  }
  return folded("", fmt::format("All {} candidates", record.evaluations.size()), table_html(table));
}

namespace {

std::string folded_values(const char* title, const std::map<std::string, std::string>& values) {
  if (values.empty()) return {};
  Table table{.columns = {{""}, {"", true}}, .rows = {}};
  for (const auto& [key, value] : values) table.rows.push_back({{Html{"<code>" + escape(key) + "</code>"}, value}});
  return folded("", title, table_html(table));
}

}  // namespace

std::string provenance_section(const RunRecord& record) {
  const Provenance& p = record.provenance;
  std::string libraries;
  for (const auto& [name, version] : p.libraries) libraries += (libraries.empty() ? "" : ", ") + name + " " + version;
  std::string text =
      definition_list({{"Program", p.program_version.empty() ? "" : "dovetail " + p.program_version},
                       {"Date", p.date_utc},
                       {"Time taken", !(record.seconds > 0)  ? ""
                                      : record.seconds < 120 ? significant(record.seconds, 3) + " s"
                                                             : significant(record.seconds / 60, 3) + " min"},
                       {"Compiler", p.compiler},
                       {"Libraries", libraries},
                       {"Study", p.study_file}});
  text += folded_values("Settings chosen for the accuracy asked for", p.settings);
  text += folded_values("Options of the optimiser", p.options);
  if (!p.study_text.empty()) text += folded("", "The study file", "<pre>" + escape(p.study_text) + "</pre>");
  return text;
}

}  // namespace dovetail::report
