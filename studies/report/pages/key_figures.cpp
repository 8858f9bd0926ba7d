// Responses of start and best design, and what they are case by case.
#include "studies/report/pages/report_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>

#include "optimizer/responses/response_table.hpp"
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
  const std::string from = significant(least / unit.si, 3), to = significant(largest / unit.si, 3);
  return Html{(from == to ? "" : from + " to ") + to + (unit.symbol.empty() ? "" : "\u00a0" + unit.symbol)};
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
  Table table{.columns = {{""}}, .rows = {}, .style = has_both(base, best) ? "figures pair" : "figures"};
  add_headings(base, best, best_word(record), table);
  for (const std::string& name : optimizer::responses_of(record.problem))
    for (const Group& group : groups_of(record.problem)) {
      if (group.members.size() == 1) {
        table.rows.push_back(
            figures_row({group.name + ": " + words(name)}, base, best, optimizer::of_case(name, group.name)));
        continue;
      }
      const EvaluationRecord* only = best ? best : base;
      const Unit unit = response_unit(name, response(*only, name));
      Row row{.cells = {group.name + ": " + words(name)}};
      if (has_both(base, best)) row.cells.push_back(range_over(base, name, group, unit));
      row.cells.push_back(range_over(only, name, group, unit));
      if (has_both(base, best)) row.cells.emplace_back("");
      table.rows.push_back(std::move(row));
    }
  return fmt::format("<p>The figures above are of the first case, {}.</p>\n",
                     escape(record.problem.cases.front().name)) +
         table_html(table);
}

}  // namespace dovetail::report
