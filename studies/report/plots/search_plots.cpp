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
  Series best{.name = {}, .stroke = Stroke::none, .mark = Mark::star};

  void add(const RunRecord& record, std::size_t i, double shown, const std::string& unit) {
    const EvaluationRecord& e = record.evaluations[i];
    best.name = best_word(record);
    Series& group = record.best == i ? best : e.feasible ? feasible : broken;
    group.add(static_cast<double>(i + 1), shown);
    group.titles.push_back(fmt::format("candidate {} ({}): {}{}{}", i + 1, e.phase, significant(shown),
                                       unit.empty() ? "" : " " + unit, e.feasible ? "" : ", infeasible"));
  }
  void add_to(Plot& plot) {
    for (Series* marks : {&broken, &feasible, &best}) plot.series.push_back(std::move(*marks));
  }
};

}  // namespace

Plot objective_plot(const RunRecord& record) {
  const ObjectiveScale scale = objective_scale(record);
  Plot plot{
      .title = "Objective over the search",
      .description =
          "Every candidate in the order it was evaluated; those that could not be computed stand at the "
          "lower edge.",
      .x = {.label = "candidate", .whole = true},
      .y = {.label = scale.label, .unit = scale.unit},
  };
  CandidateMarks marks;
  Series failed{.name = "not computed", .role = Role::muted, .stroke = Stroke::none, .mark = Mark::triangle};
  Series so_far{.name = "best so far", .role = Role::before, .steps = true};
  double least = std::numeric_limits<double>::infinity(), lowest = least, highest = -least;
  bool positive = true;
  for (std::size_t i = 0; i < record.evaluations.size(); ++i) {
    const EvaluationRecord& e = record.evaluations[i];
    const double at = static_cast<double>(i + 1), shown = scale.factor * e.objective;
    if (std::isfinite(e.objective)) {
      lowest = std::min(lowest, shown);
      highest = std::max(highest, shown);
      positive = positive && shown > 0;
      marks.add(record, i, shown, scale.unit);
      if (e.feasible) least = std::min(least, e.objective);
    }
    so_far.add(at, std::isfinite(least) ? scale.factor * least : std::numeric_limits<double>::quiet_NaN());
  }
  if (!(lowest <= highest)) return plot;
  plot.y.logarithmic = positive && highest > 30 * lowest;
  const double edge =
      plot.y.logarithmic ? std::pow(10.0, std::floor(std::log10(lowest))) : std::min(lowest, positive ? 0.0 : lowest);
  plot.y.from_zero = positive;
  for (std::size_t i = 0; i < record.evaluations.size(); ++i) {
    const EvaluationRecord& e = record.evaluations[i];
    if (std::isfinite(e.objective)) continue;
    failed.add(static_cast<double>(i + 1), edge);
    failed.titles.push_back(fmt::format("candidate {} ({}): {}", i + 1, e.phase, e.status));
  }
  if (failed.x.empty()) plot.description = "Every candidate in the order it was evaluated.";
  if (std::isfinite(least)) plot.series.push_back(std::move(so_far));
  plot.series.push_back(std::move(failed));
  marks.add_to(plot);
  return plot;
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
      if (std::isfinite(values[i])) marks.add(record, i, values[i] / unit.si, unit.symbol);
    marks.add_to(plot);
    plots.push_back(std::move(plot));
  }
  return plots;
}

}  // namespace dovetail::report
