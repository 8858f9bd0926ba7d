// What was searched, what came of every candidate and how the best one keeps its limits.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "studies/report/pages/report_tables.hpp"
#include "studies/report/plots/plot.hpp"
#include "studies/report/words/report_words.hpp"
#include "studies/report/words/table.hpp"

namespace dovetail::report {

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
    Row row{{departure_words(best)}};
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

}  // namespace dovetail::report
