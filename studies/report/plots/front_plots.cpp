// Plots of a front: the designs that no other beats, and how they were come by.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "optimizer/search/pagmo_search.hpp"
#include "studies/report/plots/report_plots.hpp"
#include "studies/report/words/report_words.hpp"
#include "studies/report/words/units.hpp"

namespace dovetail::report {

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// An objective as an axis has it.
struct Objective {
  std::size_t index;
  std::string name;
  Unit unit;

  Objective(const RunRecord& record, std::size_t at) : index(at) {
    const optimizer::ObjectiveTerm& term = record.problem.objective[at];
    name = term_words(record.problem, term);
    unit = response_unit(term.response, std::abs(record.front->reference[at]));
  }
  [[nodiscard]] PlotAxis axis() const { return {.label = name, .unit = unit.symbol}; }
  [[nodiscard]] double shown(double si) const { return si / unit.si; }
};

/// What stands beside a design when it is pointed at: its objectives, and its variables.
std::string told(const RunRecord& record, const std::string& whose, std::size_t candidate,
                 const std::vector<std::pair<double, double>>& objectives) {
  std::string text = fmt::format("{}candidate {}", whose, candidate + 1);
  for (std::size_t i = 0; i < objectives.size(); ++i) {
    const Objective objective(record, i);
    const auto& [value, bar] = objectives[i];
    text += "\n" + objective.name + " " + with_error(value, bar, objective.unit);
  }
  const std::vector<optimizer::DesignVariable>& variables = record.problem.space.variables();
  const Numbers& x = record.evaluations[candidate].x;
  for (std::size_t i = 0; i < variables.size(); ++i)
    text += fmt::format("\n{} {} {}", key_words(variables[i].key), plain(x[i], 4), key_unit(variables[i].key));
  return text;
}

/// Objectives of any candidate, as the search has them.
std::vector<std::pair<double, double>> objectives_of(const RunRecord& record, std::size_t candidate) {
  std::vector<std::pair<double, double>> all;
  for (const optimizer::ObjectiveTerm& term : record.problem.objective) {
    const auto [value, bar] = shown_term(record.problem, term, record.evaluations[candidate]);
    all.emplace_back(value, bar);
  }
  return all;
}

bool counts(const RunRecord& record, const std::vector<std::pair<double, double>>& objectives) {
  for (std::size_t i = 0; i < objectives.size(); ++i) {
    const double beyond = objectives[i].first - record.front->reference[i];
    if (!(record.problem.objective[i].weight * beyond < 0)) return false;
  }
  return true;
}

Plot front_plot(const RunRecord& record, std::size_t other) {
  const FrontRecord& front = *record.front;
  const Objective across(record, 0), up(record, other);
  Plot plot{.title = "Front of " + across.name + " and " + up.name,
            .description =
                "Point at a design for its numbers. Lines through points are error bars, where they were "
                "computed, as far as the designs that are shown; designs beyond the reference are left out.",
            .x = across.axis(),
            .y = up.axis()};
  Series beaten{.name = "beaten", .role = Role::muted, .stroke = Stroke::none, .mark = Mark::dot};
  Series broken{.name = "breaks a limit", .role = Role::bad, .stroke = Stroke::none, .mark = Mark::cross};
  Series start{.name = "start", .role = Role::before, .stroke = Stroke::none, .mark = Mark::triangle};
  Series bars{.name = {}, .role = Role::after};
  Series points{.name = "front", .stroke = Stroke::none, .mark = Mark::circle};
  Series compromise{.name = "compromise", .stroke = Stroke::none, .mark = Mark::star};
  const auto add = [&](Series& series, std::size_t candidate, double x, double y, std::string title) {
    series.add(across.shown(x), up.shown(y));
    series.titles.push_back(std::move(title));
    series.candidates.push_back(candidate);
  };
  for (std::size_t i = 0; i < record.evaluations.size(); ++i) {
    const EvaluationRecord& e = record.evaluations[i];
    if (!std::isfinite(e.objective) || std::ranges::count(front.evaluation, static_cast<std::int64_t>(i)) > 0) continue;
    const auto objectives = objectives_of(record, i);
    const bool first = record.baseline == i;
    if (!first && !counts(record, objectives)) continue;
    const std::string whose = std::string(first ? "start, " : "") + (e.feasible ? "" : "breaks a limit, ");
    if (first) start.labels.push_back("start");
    add(first        ? start
        : e.feasible ? beaten
                     : broken,
        i, objectives[0].first, objectives[other].first, told(record, whose, i, objectives));
  }
  for (std::size_t point = 0; point < front.evaluation.size(); ++point) {
    std::vector<std::pair<double, double>> objectives;
    for (std::size_t i = 0; i < front.columns(); ++i)
      objectives.emplace_back(front.value(point, i), front.bar(point, i));
    const bool chosen = static_cast<std::int64_t>(point) == front.compromise;
    const auto candidate = static_cast<std::size_t>(front.evaluation[point]);
    add(chosen ? compromise : points, candidate, objectives[0].first, objectives[other].first,
        told(record, fmt::format("{}point {}, ", chosen ? "compromise, " : "", point + 1), candidate, objectives));
  }
  // A bar that is much longer than the front would leave no room for it.
  Bounds wide, high;
  for (const Series* series : {&broken, &beaten, &points, &start, &compromise})
    for (std::size_t i = 0; i < series->x.size(); ++i) {
      wide.add(series->x[i]);
      high.add(series->y[i]);
    }
  for (std::size_t point = 0; point < front.evaluation.size(); ++point) {
    const double x = across.shown(front.value(point, 0)), y = up.shown(front.value(point, other));
    const double x_bar = across.shown(front.bar(point, 0)), y_bar = up.shown(front.bar(point, other));
    const auto line = [&](double from_x, double from_y, double to_x, double to_y) {
      bars.add(from_x, from_y);
      bars.add(to_x, to_y);
      bars.add(kNaN, kNaN);
    };
    if (std::isfinite(x_bar)) line(std::max(x - x_bar, wide.lower), y, std::min(x + x_bar, wide.upper), y);
    if (std::isfinite(y_bar)) line(x, std::max(y - y_bar, high.lower), x, std::min(y + y_bar, high.upper));
  }
  for (Series* series : {&broken, &beaten, &bars, &points, &start, &compromise})
    if (!series->x.empty()) plot.series.push_back(std::move(*series));
  return plot;
}

}  // namespace

std::vector<Figure> front_plots(const RunRecord& record) {
  std::vector<Figure> plots;
  if (!record.front) return plots;
  for (std::size_t other = 1; other < record.front->columns(); ++other) plots.emplace_back(front_plot(record, other));
  return plots;
}

Plot hypervolume_plot(const RunRecord& record) {
  const FrontRecord& front = *record.front;
  Plot plot{.title = "Hypervolume over the search",
            .description =
                "What the designs seen so far dominate, by what all of them do. Flat at the end: more of the "
                "same brings little.",
            .x = {.label = "candidate", .whole = true},
            .y = {.label = "hypervolume", .unit = "%", .from_zero = true}};
  const auto as_less = [&](std::size_t i, double value) {
    return record.problem.objective[i].weight < 0 ? -value : value;
  };
  std::vector<double> reference;
  for (std::size_t i = 0; i < front.columns(); ++i) reference.push_back(as_less(i, front.reference[i]));
  Series so_far{.name = {}, .steps = true};
  std::vector<std::vector<double>> seen;  // that no other of them beats
  double volume = 0;
  for (std::size_t at = 0; at < record.evaluations.size(); ++at) {
    const EvaluationRecord& e = record.evaluations[at];
    if (e.feasible && std::isfinite(e.objective)) {
      std::vector<double> terms;
      for (const auto& [value, bar] : objectives_of(record, at)) terms.push_back(as_less(terms.size(), value));
      const auto beats = [](const std::vector<double>& a, const std::vector<double>& b) {
        return std::ranges::equal(a, b, std::less_equal<>());
      };
      if (std::ranges::none_of(seen, [&](const auto& other) { return beats(other, terms); })) {
        std::erase_if(seen, [&](const auto& other) { return beats(terms, other); });
        seen.push_back(std::move(terms));
        volume = optimizer::hypervolume(seen, reference);
      }
    }
    so_far.add(static_cast<double>(at + 1), volume);
  }
  if (volume > 0)
    for (double& y : so_far.y) y *= 100 / volume;
  plot.series.push_back(std::move(so_far));
  return plot;
}

}  // namespace dovetail::report
