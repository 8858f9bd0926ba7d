// Plots of the search: what the candidates came to.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

#include "studies/report/plots/report_plots.hpp"
#include "studies/report/words/report_words.hpp"

namespace dovetail::report {

namespace {

/// The candidates that have a value, with the best on top.
struct CandidateMarks {
  Series broken{.name = "breaks a limit", .role = Role::bad, .stroke = Stroke::none, .mark = Mark::cross};
  Series feasible{.name = "feasible", .stroke = Stroke::none, .mark = Mark::circle};
  Series best{.name = {}, .role = Role::one, .stroke = Stroke::none, .mark = Mark::star};

  void add(const RunRecord& record, std::size_t i, double at, double shown, const std::string& unit) {
    const EvaluationRecord& e = record.evaluations[i];
    best.name = best_word(record);
    Series& group = record.best == i ? best : e.feasible ? feasible : broken;
    group.add(at, shown);
    group.candidates.push_back(i);
    group.titles.push_back(fmt::format("candidate {} ({}): {}{}{}", i + 1, e.phase, significant(shown),
                                       unit.empty() ? "" : " " + unit, e.feasible ? "" : ", infeasible"));
  }
  void add_to(Plot& plot) {
    for (Series* marks : {&broken, &feasible, &best}) plot.series.push_back(std::move(*marks));
  }
};

/// The objective of all candidates by where each stands across; those without a value at the lower edge.
template <class Place>
Plot objective_marks(const RunRecord& record, Plot plot, Place&& place) {
  const ObjectiveScale scale = objective_scale(record);
  plot.y = {.label = scale.label, .unit = scale.unit};
  plot.at_zero = "It is zero for every candidate.";
  CandidateMarks marks;
  Series failed{.name = "not computed", .role = Role::muted, .stroke = Stroke::none, .mark = Mark::triangle};
  Bounds values;
  for (std::size_t i = 0; i < record.evaluations.size(); ++i)
    if (const double shown = scale.factor * record.evaluations[i].objective; std::isfinite(shown)) {
      values.add(shown);
      marks.add(record, i, place(i), shown, scale.unit);
    }
  if (values.empty()) return plot;
  const bool positive = values.lower > 0;
  plot.y.logarithmic = positive && values.upper > 30 * values.lower;
  plot.y.from_zero = positive;
  const double edge = plot.y.logarithmic ? std::pow(10.0, std::floor(std::log10(values.lower)))
                                         : std::min(values.lower, positive ? 0.0 : values.lower);
  for (std::size_t i = 0; i < record.evaluations.size(); ++i) {
    const EvaluationRecord& e = record.evaluations[i];
    if (std::isfinite(e.objective)) continue;
    failed.add(place(i), edge);
    failed.candidates.push_back(i);
    failed.titles.push_back(fmt::format("candidate {} ({}): {}", i + 1, e.phase, e.status));
  }
  plot.series.push_back(std::move(failed));
  marks.add_to(plot);
  return plot;
}

}  // namespace

Plot objective_plot(const RunRecord& record) {
  Plot plot = objective_marks(record,
                              {.title = "Objective over the search",
                               .description = "Every candidate in the order it was evaluated; those that could not be "
                                              "computed stand at the lower edge.",
                               .x = {.label = "candidate", .whole = true}},
                              [](std::size_t i) { return static_cast<double>(i + 1); });
  if (plot.series.empty()) return plot;
  if (plot.series.front().x.empty()) plot.description = "Every candidate in the order it was evaluated.";
  const double factor = objective_scale(record).factor;
  Series so_far{.name = "best so far", .role = Role::before, .steps = true};
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < record.evaluations.size(); ++i) {
    const EvaluationRecord& e = record.evaluations[i];
    if (e.feasible && std::isfinite(e.objective)) least = std::min(least, e.objective);
    so_far.add(static_cast<double>(i + 1), std::isfinite(least) ? factor * least : std::nan(""));
  }
  if (std::isfinite(least)) plot.series.insert(plot.series.begin(), std::move(so_far));
  return plot;
}

std::vector<Figure> variable_plots(const RunRecord& record) {
  std::vector<Figure> plots;
  const std::vector<optimizer::DesignVariable>& variables = record.problem.space.variables();
  for (std::size_t v = 0; v < variables.size(); ++v) {
    const std::string name = key_words(variables[v].key);
    plots.emplace_back(objective_marks(
        record, {.title = "Over the " + name, .x = {.label = name, .unit = key_unit(variables[v].key)}},
        [&](std::size_t i) { return v < record.evaluations[i].x.size() ? record.evaluations[i].x[v] : std::nan(""); }));
  }
  return plots;
}

std::vector<Figure> limit_plots(const RunRecord& record) {
  std::vector<Figure> plots;
  std::vector<std::string> done;
  for (const optimizer::ResponseConstraint& limited : record.problem.constraints) {
    if (std::find(done.begin(), done.end(), limited.response) != done.end()) continue;
    done.push_back(limited.response);
    Numbers values;
    for (const EvaluationRecord& e : record.evaluations) values.push_back(response(e, limited.response));
    const Unit unit = response_unit(limited.response, largest(values));
    Plot plot{.title = words(limited.response) + " over the search",
              .x = {.label = "candidate", .whole = true},
              .y = {.label = words(limited.response), .unit = unit.symbol}};
    plot.title.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(plot.title.front())));
    for (const optimizer::ResponseConstraint& c : record.problem.constraints) {
      if (c.response != limited.response) continue;
      const std::string of = c.absolute ? " (magnitude)" : "";
      if (c.upper) plot.levels.push_back({.name = "at most " + plain(*c.upper, unit) + of, .y = *c.upper / unit.si});
      if (c.lower) plot.levels.push_back({.name = "at least " + plain(*c.lower, unit) + of, .y = *c.lower / unit.si});
      if (c.absolute && c.upper) plot.levels.push_back({.name = {}, .y = -*c.upper / unit.si});
    }
    CandidateMarks marks;
    for (std::size_t i = 0; i < values.size(); ++i)
      if (std::isfinite(values[i])) marks.add(record, i, static_cast<double>(i + 1), values[i] / unit.si, unit.symbol);
    marks.add_to(plot);
    plots.push_back(std::move(plot));
  }
  return plots;
}

}  // namespace dovetail::report
