#include "studies/work_precision/evaluations/points.hpp"

#include <algorithm>
#include <cmath>

namespace dovetail::work_precision {
namespace {

void judge(const WholeDiagram& diagram, WholePoint& point) {
  point.error.clear();
  point.worst = kUnknown;
  const WholeRun& finest = diagram.reference.finest.run;
  if (!finest.converged()) return;
  for (const auto& [name, truth] : finest.responses) {
    if (truth == 0 || !std::isfinite(truth)) continue;
    const auto value = point.run.responses.find(name);
    const bool known = point.run.converged() && value != point.run.responses.end();
    point.error[name] = known ? std::abs(value->second / truth - 1) : kUnknown;
  }
  double worst = 0;
  for (const std::string& name : diagram.judged) {
    const double error = error_of(point, name);
    worst = std::isnan(error) ? kUnknown : std::max(worst, error);
    if (std::isnan(worst)) break;
  }
  point.worst = worst;
}

bool as_fine(const WholeSetting& a, const WholeSetting& b) {
  return a.mesh >= b.mesh && a.mesh * a.beside >= b.mesh * b.beside && a.harmonics >= b.harmonics &&
         a.samples >= b.samples && a.modes >= b.modes && a.resonance_tolerance <= b.resonance_tolerance &&
         a.tolerance <= b.tolerance;
}

}  // namespace

std::vector<const WholePoint*> WholeDiagram::points() const {
  std::vector<const WholePoint*> all;
  for (const WholeLine& line : lines)
    for (const WholePoint& point : line.points) all.push_back(&point);
  for (const AutomaticChoice& choice : automatic) all.push_back(&choice.point);
  return all;
}

const WholePoint* WholeDiagram::paper() const {
  for (const WholeLine& line : lines)
    if (line.key == WholeSweep::paper && !line.points.empty()) return &line.points.front();
  return nullptr;
}

double error_of(const WholePoint& point, const std::string& response) {
  if (response == kWorst) return point.worst;
  const auto found = point.error.find(response);
  return found == point.error.end() ? kUnknown : found->second;
}

void judge(WholeDiagram& diagram) {
  judge(diagram, diagram.reference.finest);
  judge(diagram, diagram.reference.check);
  for (WholeLine& line : diagram.lines)
    for (WholePoint& point : line.points) judge(diagram, point);
  for (AutomaticChoice& choice : diagram.automatic) judge(diagram, choice.point);
}

WholePoint judged_point(const WholeDiagram& diagram, const std::string& label, const WholeRun& run) {
  WholePoint point{.label = label, .run = run};
  judge(diagram, point);
  return point;
}

std::vector<const WholePoint*> front(const WholeDiagram& diagram, const std::string& response) {
  std::vector<const WholePoint*> all = diagram.points();
  std::erase_if(all, [&](const WholePoint* point) { return std::isnan(error_of(*point, response)); });
  std::ranges::stable_sort(all, {}, [](const WholePoint* point) { return point->run.seconds; });
  std::vector<const WholePoint*> best;
  for (const WholePoint* point : all)
    if (best.empty() || error_of(*point, response) < error_of(*best.back(), response)) best.push_back(point);
  return best;
}

const WholePoint* cheapest(const WholeDiagram& diagram, const std::string& response, double error) {
  for (const WholePoint* point : front(diagram, response))
    if (error_of(*point, response) <= error) return point;
  return nullptr;
}

double steady_error(const WholeDiagram& diagram, const WholePoint& point) {
  double largest = point.worst;
  if (std::isnan(largest)) return largest;
  for (const WholePoint* other : diagram.points())
    if (!other->run.in_steps && as_fine(other->run.setting, point.run.setting) && other->worst > largest)
      largest = other->worst;
  return largest;
}

const WholePoint* cheapest_steady(const WholeDiagram& diagram, double error) {
  const WholePoint* best = nullptr;
  for (const WholePoint* point : diagram.points())
    if (steady_error(diagram, *point) <= error && (best == nullptr || point->run.seconds < best->run.seconds))
      best = point;
  return best;
}

Comparison compare(const WholeDiagram& diagram, const AutomaticChoice& choice) {
  Comparison comparison;
  const WholePoint& chosen = choice.point;
  comparison.for_asked = cheapest(diagram, kWorst, choice.asked);
  if (comparison.for_asked) comparison.factor_asked = chosen.run.seconds / comparison.for_asked->run.seconds;
  comparison.steady = cheapest_steady(diagram, choice.asked);
  if (comparison.steady) comparison.factor_steady = chosen.run.seconds / comparison.steady->run.seconds;
  if (std::isnan(chosen.worst)) return comparison;
  const double unresolved = std::isnan(diagram.agreement()) ? 0 : diagram.agreement();
  comparison.for_error = cheapest(diagram, kWorst, std::max(chosen.worst, unresolved));
  if (comparison.for_error) comparison.factor_error = chosen.run.seconds / comparison.for_error->run.seconds;
  return comparison;
}

}  // namespace dovetail::work_precision
