// All candidates of a run as data of one drawing.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "studies/report/plots/chart.hpp"
#include "studies/report/plots/report_plots.hpp"
#include "studies/report/words/report_words.hpp"
#include "studies/report/words/units.hpp"

namespace dovetail::report {

namespace {

using nlohmann::json;

/// What is said of every candidate, and where its limits are.
struct Measure {
  json axis;
  Numbers values;  ///< of all candidates, as the axis has them
};

Measure variable_measure(const RunRecord& record, std::size_t index) {
  const optimizer::DesignVariable& variable = record.problem.space.variables()[index];
  Measure measure{.axis = {{"label", key_words(variable.key)},
                           {"unit", key_unit(variable.key)},
                           {"of", "variable"},
                           {"lower", chart_number(variable.lower)},
                           {"upper", chart_number(variable.upper)}},
                  .values = {}};
  for (const EvaluationRecord& e : record.evaluations)
    measure.values.push_back(index < e.x.size() ? e.x[index] : std::nan(""));
  return measure;
}

Measure measure_of(const std::string& label, const char* of, const std::string& response, Numbers si) {
  const Unit unit = response_unit(response, largest(si));
  return {.axis = {{"label", label}, {"unit", unit.symbol}, {"of", of}}, .values = scaled(si, unit.si)};
}

std::vector<Measure> measures_of(const RunRecord& record) {
  std::vector<Measure> all;
  for (std::size_t i = 0; i < record.problem.space.variables().size(); ++i) all.push_back(variable_measure(record, i));
  std::vector<std::string> shown;
  for (const optimizer::ObjectiveTerm& term : record.problem.objective) {
    Numbers si;
    for (const EvaluationRecord& e : record.evaluations)
      si.push_back(std::isfinite(e.objective) ? shown_term(record.problem, term, e).value : std::nan(""));
    shown.push_back(term.response);
    all.push_back(measure_of(term_words(record.problem, term), "objective", term.response, std::move(si)));
  }
  if (record.problem.objective.size() > 1 && !record.problem.front) {
    Numbers sum;
    for (const EvaluationRecord& e : record.evaluations) sum.push_back(e.objective);
    all.push_back({.axis = {{"label", "weighted sum"}, {"unit", ""}, {"of", "objective"}}, .values = std::move(sum)});
  }
  for (const optimizer::ResponseConstraint& limit : record.problem.constraints) {
    if (std::ranges::count(shown, limit.response) > 0) continue;
    shown.push_back(limit.response);
    Numbers si;
    for (const EvaluationRecord& e : record.evaluations) si.push_back(response(e, limit.response));
    all.push_back(measure_of(words(limit.response), "limit", limit.response, std::move(si)));
  }
  return all;
}

const char* state_of(const RunRecord& record, std::size_t i) {
  const EvaluationRecord& e = record.evaluations[i];
  if (record.best == i) return "best";
  if (record.baseline == i) return "start";
  if (!std::isfinite(e.objective)) return "failed";
  return e.feasible ? "feasible" : "broken";
}

}  // namespace

std::string candidates_chart(const RunRecord& record) {
  if (record.evaluations.empty()) return {};
  const std::vector<Measure> measures = measures_of(record);
  json data{{"axes", json::array()}, {"candidates", json::array()}, {"best", best_word(record)}};
  for (const Measure& measure : measures) data["axes"].push_back(measure.axis);
  for (std::size_t i = 0; i < record.evaluations.size(); ++i) {
    const EvaluationRecord& e = record.evaluations[i];
    json values = json::array();
    for (const Measure& measure : measures) values.push_back(chart_number(measure.values[i]));
    data["candidates"].push_back({{"state", state_of(record, i)},
                                  {"phase", e.phase},
                                  {"status", !optimizer::converged(e.status) ? e.status
                                             : e.feasible                    ? "feasible"
                                                                             : "breaks a limit"},
                                  {"values", std::move(values)}});
  }
  return chart_html("candidates", "All candidates over variables, objectives and limits", data);
}

}  // namespace dovetail::report
