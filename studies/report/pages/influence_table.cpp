// What the variables do to objectives and limits.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "studies/report/pages/report_tables.hpp"
#include "studies/report/record/influence.hpp"
#include "studies/report/words/report_words.hpp"
#include "studies/report/words/table.hpp"
#include "studies/report/words/units.hpp"

namespace dovetail::report {

namespace {

const char* words_of(Trend trend) {
  switch (trend) {
    case Trend::rises:
      return "rises";
    case Trend::falls:
      return "falls";
    case Trend::valley:
      return "valley";
    case Trend::hill:
      return "hill";
  }
  return "";
}

struct Answer {
  std::string name;
  Influence influence;
};

std::vector<Answer> answers_of(const RunRecord& record) {
  std::vector<Answer> answers;
  std::vector<std::string> seen;
  const auto add = [&](const std::string& name, const Numbers& values) {
    answers.push_back({name, influence(record, values)});
  };
  for (const optimizer::ObjectiveTerm& term : record.problem.objective) {
    Numbers values;
    for (const EvaluationRecord& e : record.evaluations)
      values.push_back(std::isfinite(e.objective) ? shown_term(record.problem, term, e).value : std::nan(""));
    seen.push_back(term.response);
    add(term_words(record.problem, term), values);
  }
  for (const optimizer::ResponseConstraint& limit : record.problem.constraints) {
    if (std::ranges::count(seen, limit.response) > 0) continue;
    seen.push_back(limit.response);
    Numbers values;
    for (const EvaluationRecord& e : record.evaluations) values.push_back(response(e, limit.response));
    add(words(limit.response), values);
  }
  return answers;
}

/// Behind the name of the quantity, which is seen where there is no room for a head.
Html named_cell(const Answer& answer, const std::string& html) {
  return {"<span class=\"label\">" + escape(answer.name) + "</span>" + html};
}

std::string share_html(const VariableInfluence& of) {
  const double per_cent = 100 * of.share;
  if (per_cent < 2) return "<span class=\"soft\">little</span>";
  return fmt::format(
      "<span class=\"share\" style=\"--share:{0:.0f}%\">{0:.0f}\u00a0% <span class=\"soft\">{1}</span></span>",
      per_cent, words_of(of.trend));
}

}  // namespace

std::string influence_table(const RunRecord& record) {
  const std::vector<Answer> answers = answers_of(record);
  const std::vector<optimizer::DesignVariable>& variables = record.problem.space.variables();
  if (answers.empty() || variables.empty()) return {};
  Table table{.columns = {{"", true}}, .rows = {}, .style = "influence"};
  Row explained{.cells = {"all of them together"}, .style = "soft"};
  for (const Answer& answer : answers) {
    table.columns.push_back({answer.name, true});
    explained.cells.emplace_back(named_cell(
        answer, answer.influence.variables.empty() ? std::string("\u2013")
                                                   : fmt::format("{:.0f}\u00a0%", 100 * answer.influence.explained)));
  }
  for (std::size_t v = 0; v < variables.size(); ++v) {
    Row row{.cells = {key_words(variables[v].key)}};
    for (const Answer& answer : answers)
      row.cells.emplace_back(named_cell(answer, v < answer.influence.variables.size()
                                                    ? share_html(answer.influence.variables[v])
                                                    : std::string("\u2013")));
    table.rows.push_back(std::move(row));
  }
  table.rows.push_back(std::move(explained));
  if (std::ranges::all_of(answers, [](const Answer& answer) { return answer.influence.variables.empty(); }))
    return fmt::format(
        "<p>With {} candidates that have values nothing can be said of the influence of {} variables: it takes {}, and "
        "values that differ.</p>\n",
        answers.front().influence.candidates, variables.size(), 4 * variables.size() + 2);
  return table_html(table) +
         "<p class=\"soft\">Share of the scatter among the candidates seen that goes with each variable, from a fit "
         "with a parabola in each of them to ranks, and which way it goes: the quantity rises or falls with the "
         "variable, or "
         "has a valley or a hill within its range. What is missing to 100\u00a0% is left to variables that act "
         "together, and to noise.</p>\n";
}

}  // namespace dovetail::report
