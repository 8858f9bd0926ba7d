#include "studies/work_precision/figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "studies/report/plots/plot.hpp"

namespace dovetail::work_precision {
namespace {

using report::Mark;
using report::Plot;
using report::Role;
using report::Series;
using report::Stroke;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::string described(const Line& line, const Point& point, const Sweep& sweep, std::size_t quantity) {
  return fmt::format("{}{}{}: {:.3g} s, {}", line.name, line.name.empty() ? "" : ", ", point.label,
                     sweep.seconds(point),
                     point.run.converged() ? fmt::format("error {:.2g}", point.error[quantity]) : point.run.status);
}

// The number in "H = 3", "1 eps" or "24 edges": the sweep's title says what it is.
std::string value_of(const std::string& label) {
  const std::size_t from = label.starts_with("H = ") || label.starts_with("N = ") ? 4 : 0;
  return label.substr(from, label.find(' ', from) - from);
}

// Errors below this are rounding and the tolerance of the search for the resonance.
constexpr double kLowest = 1e-9;

double drawn(double error) {
  return error > 0 ? std::max(error, kLowest) : kNan;
}

// The error that the mesh of the default setting makes, NaN without one.
double mesh_error(const Diagram& diagram, std::size_t quantity) {
  for (const Sweep& sweep : diagram.sweeps)
    if (sweep.key == SweepKey::mesh)
      for (const Line& line : sweep.lines)
        for (const Point& point : line.points)
          if (point.is_default) return point.own_error[quantity];
  return kNan;
}

/// Lines across the plot: errors that the setting cannot take away.
void add_levels(const Diagram& diagram, const Sweep& sweep, std::size_t quantity, const report::Bounds& x,
                report::Bounds& y, Plot& plot) {
  const auto level = [&](const std::string& name, double value, Role role, Stroke stroke) {
    if (!(value > 0)) return;
    const double shown = std::max(value, kLowest);
    y.add(shown);
    plot.series.push_back({.name = name, .x = {x.lower, x.upper}, .y = {shown, shown}, .role = role, .stroke = stroke});
  };
  if (sweep.key != SweepKey::mesh)
    level("part by the default mesh", mesh_error(diagram, quantity), Role::bad, Stroke::dashed);
  level("the references agree to this", diagram.reference_of(sweep).agreement[quantity], Role::muted, Stroke::dashed);
}

}  // namespace

Plot error_plot(const Diagram& diagram, const Sweep& sweep, std::size_t quantity) {
  Plot plot{.title = kQuantities[quantity],
            .x = {.label = sweep.with_model_time ? "model and resonance" : "resonance",
                  .unit = "s",
                  .logarithmic = true,
                  .tight = true},
            .y = {.label = "relative error", .logarithmic = true}};
  plot.title[0] = static_cast<char>(std::toupper(plot.title[0]));
  constexpr std::array<std::pair<Role, Stroke>, 3> kLook{
      {{Role::after, Stroke::solid}, {Role::before, Stroke::solid}, {Role::before, Stroke::dashed}}};
  report::Bounds x, y;
  Series star{.name = "default", .stroke = Stroke::none, .mark = Mark::star};
  Series failed{.name = "failed", .role = Role::bad, .stroke = Stroke::none, .mark = Mark::cross};
  std::vector<Series> own;
  for (std::size_t l = 0; l < sweep.lines.size(); ++l) {
    const Line& line = sweep.lines[l];
    const auto& [role, stroke] = kLook[std::min(l, kLook.size() - 1)];
    Series total{.name = line.name.empty() ? "error" : line.name, .role = role, .stroke = stroke, .mark = Mark::dot};
    Series part{.name = "part of it by this setting alone", .role = Role::muted, .stroke = Stroke::dotted};
    for (const Point& point : line.points) {
      const double seconds = sweep.seconds(point), error = drawn(point.error[quantity]);
      x.add(seconds);
      if (!point.run.converged()) {
        failed.x.push_back(seconds);
        failed.titles.push_back(described(line, point, sweep, quantity));
        continue;
      }
      y.add(error);
      total.add(seconds, error);
      total.labels.push_back(l == 0 || sweep.key == SweepKey::solver ? value_of(point.label) : "");
      part.add(seconds, drawn(point.own_error[quantity]));
      y.add(part.y.back());
      if (!point.is_default || !star.x.empty()) continue;
      star.add(seconds, error);
      star.titles.push_back(described(line, point, sweep, quantity));
    }
    plot.series.push_back(std::move(total));
    if (sweep.refines && l == 0) own.push_back(std::move(part));
  }
  for (Series& part : own) plot.series.push_back(std::move(part));
  add_levels(diagram, sweep, quantity, x, y, plot);
  // Failed runs stand above all errors.
  failed.y.assign(failed.x.size(), y.upper > 0 ? 2 * y.upper : 1);
  plot.series.push_back(std::move(star));
  plot.series.push_back(std::move(failed));
  return plot;
}

Plot growth_plot(const Growth& growth) {
  Plot plot{.title = "Over " + growth.title,
            .description = growth.fixed + ", half of the nodes stuck",
            .x = {.label = growth.title, .logarithmic = true, .tight = true},
            .y = {.label = "time", .unit = "s", .logarithmic = true}};
  struct Part {
    const char* name;
    double StepTimes::*seconds;
    Role role;
    Stroke stroke;
  };
  constexpr std::array<Part, 7> kParts{
      {{"whole Newton step", &StepTimes::step, Role::after, Stroke::solid},
       {"condensed Jacobian and its LU", &StepTimes::linearise, Role::after, Stroke::dashed},
       {"solve", &StepTimes::solve, Role::after, Stroke::dotted},
       {"residual with derivative D", &StepTimes::derivative, Role::before, Stroke::solid},
       {"residual", &StepTimes::residual, Role::before, Stroke::dotted},
       {"dense Jacobian, all unknowns", &StepTimes::jacobian, Role::bad, Stroke::dashed},
       {"dense LU, all unknowns", &StepTimes::lu, Role::bad, Stroke::solid}}};
  for (const Part& part : kParts) {
    Series line{.name = part.name, .role = part.role, .stroke = part.stroke, .mark = Mark::dot};
    for (std::size_t i = 0; i < growth.size.size(); ++i)
      line.add(growth.size[i], growth.times[i].status == Status::converged ? growth.times[i].*part.seconds : kNan);
    plot.series.push_back(std::move(line));
  }
  return plot;
}

}  // namespace dovetail::work_precision
