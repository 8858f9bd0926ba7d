#include "studies/work_precision/sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace dovetail::work_precision {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::array<double, 3> error_of(const Run& run, const Run& reference) {
  if (run.converged() && reference.converged()) return relative_difference(run, reference);
  return {kNan, kNan, kNan};
}

double worst(const Point& point) {
  double result = 0;
  for (const double error : point.error) result = std::isnan(error) ? kNan : std::max(result, error);
  return point.run.converged() ? result : kNan;
}

std::string percent(double error) {
  return error < 1e-6 ? "less than 0.0001 %" : fmt::format("{:.2g} %", 100 * error);
}

std::string errors(const Point& point) {
  return fmt::format("{} in frequency, {} in energy and {} in amplitude", percent(point.error[0]),
                     percent(point.error[1]), percent(point.error[2]));
}

std::string beside(const Sweep& sweep, const Point& other, const Point& at) {
  if (!other.run.converged()) return other.label + " fails (" + other.run.status + ")";
  return fmt::format("{} takes {:.2g} times as long for {}", other.label, sweep.seconds(other) / sweep.seconds(at),
                     percent(worst(other)));
}

struct Place {
  const Line* line = nullptr;
  std::size_t at = 0;
};

Place default_of(const Sweep& sweep) {
  for (const Line& line : sweep.lines)
    for (std::size_t i = 0; i < line.points.size(); ++i)
      if (line.points[i].is_default) return {&line, i};
  return {};
}

}  // namespace

Reference refer(const Subject& subject, const Setting& finest, const Setting& check) {
  Reference reference{.run = subject(finest), .check = subject(check)};
  reference.agreement = error_of(reference.check, reference.run);
  return reference;
}

Line compute(const Subject& subject, const std::string& name, const std::vector<Planned>& plan,
             const Setting& defaults) {
  Line line{.name = name, .points = {}};
  for (const Planned& planned : plan) {
    Setting compared = planned.setting;
    compared.cascade = defaults.cascade;
    line.points.push_back(
        {.label = planned.label, .run = subject(planned.setting), .is_default = compared == defaults});
  }
  return line;
}

void judge(Diagram& diagram) {
  for (Sweep& sweep : diagram.sweeps)
    for (Line& line : sweep.lines)
      for (Point& point : line.points) {
        point.error = error_of(point.run, diagram.reference_of(sweep).run);
        point.own_error =
            sweep.refines ? error_of(point.run, line.points.back().run) : std::array<double, 3>{kNan, kNan, kNan};
      }
}

std::string verdict(const Sweep& sweep, double goal) {
  const Place place = default_of(sweep);
  if (!place.line) return "The default is not among these settings.";
  const std::vector<Point>& points = place.line->points;
  const Point& at = points[place.at];
  if (!at.run.converged()) return "The default fails here: " + at.run.status + ".";
  std::string text = fmt::format("Default {}: errors of {}, in {:.2g} s.", at.label, errors(at), sweep.seconds(at));
  std::string neighbours;
  if (place.at > 0) neighbours = beside(sweep, points[place.at - 1], at);
  if (place.at + 1 < points.size())
    neighbours += (neighbours.empty() ? "" : "; ") + beside(sweep, points[place.at + 1], at);
  for (const Line& line : sweep.lines)
    if (&line != place.line && sweep.key == SweepKey::solver)
      for (const Point& point : line.points)
        if (point.run.setting.harmonics == at.run.setting.harmonics)
          neighbours += (neighbours.empty() ? "" : "; ") + line.name + " at " + beside(sweep, point, at);
  if (!neighbours.empty()) text += " By the largest of them: " + neighbours + ".";

  const Point* cheapest = nullptr;
  for (const Line& line : sweep.lines)
    for (const Point& point : line.points)
      if (worst(point) <= goal && (!cheapest || sweep.seconds(point) < sweep.seconds(*cheapest))) cheapest = &point;
  if (!cheapest) return text + fmt::format(" No setting here keeps all three errors below {:.2g} %.", 100 * goal);
  text += fmt::format(" The cheapest setting with all three errors below {:.2g} % is {}", 100 * goal, cheapest->label);
  if (cheapest == &at) return text + ", the default.";
  return text + fmt::format(", in {:.2g} of the default's time.", sweep.seconds(*cheapest) / sweep.seconds(at));
}

}  // namespace dovetail::work_precision
