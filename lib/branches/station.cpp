#include "branches/station.hpp"

#include <algorithm>
#include <cmath>

#include "branches/params.hpp"

namespace dovetail::branches {
namespace {

// On a branch sign(ds / d arc) sign(det J) is constant, over turns and over kinks: where two pieces of a piecewise
// smooth f meet their Jacobians differ by a rank-one matrix along the normal of the border, so the branch crosses it
// the same way on both sides. That tells a sharp kink from a way back. It fails at a crossing with another branch,
// which goes on straight, and says the wrong thing on the middle of a fold smaller than the step: both are doubtful.
void orient(const Station& now, const Vector& way, int determinant, Station& next) {
  if (next.metric.inner(way, next.tangent) < 0) next.tangent = -1 * next.tangent;
  const int here = determinant * (next.tangent.parameter > 0 ? 1 : -1);
  next.orientation = here != 0 ? here : now.orientation;
  next.doubtful = here != 0 && now.orientation != 0 && here != now.orientation;
  const double cosine = now.metric.inner(now.tangent, next.tangent) / now.metric.length(next.tangent);
  if (!next.doubtful || cosine > CorrectorParams{}.straight) return;
  next.tangent = -1 * next.tangent;
  next.orientation = now.orientation;
}

}  // namespace

std::optional<Station> StationMaker::first(steady::State state, double parameter, double sign) {
  Station now;
  now.at = {.displacement = state.displacement, .parameter = parameter};
  now.metric = metric_at(state);
  const Direction found =
      equations_.direction(*state.tangent, now.metric.forwards(now.at.displacement, sign), now.metric);
  failure_ = found.status;
  if (found.status != Status::converged) return {};
  now.tangent = now.metric.unit(found.direction);
  now.orientation = state.tangent->factors().determinant_sign() * (now.tangent.parameter > 0 ? 1 : -1);
  now.state = std::move(state);
  if (!equations_.options().linearise) now.state.tangent.reset();
  return now;
}

// One unit is a change of the contact by the size of its vibration, or the step of the parameter that counts as much.
ArcMetric StationMaker::metric_at(const steady::State& state) {
  const double vibrating = vibrating_force(state);
  largest_forces_ = std::max({largest_forces_, vibrating, MetricParams{}.static_part * penalty_forces(state).norm()});
  largest_output_ = std::max(largest_output_, vibration(state.outputs));
  return arc_metric(state, std::max(vibrating, MetricParams{}.floor * largest_forces_),
                    follow_.largest_parameter_step * interval_ / follow_.largest_change);
}

std::optional<Station> StationMaker::advance(const Station& now, const Vector& direction, double step) {
  return described(now, equations_.correct(now.at + step * direction, direction, now.metric, follow_.max_corrections),
                   direction, step);
}

std::optional<Station> StationMaker::at_parameter(const Station& now, const Vector& start, double step) {
  return described(now, equations_.correct_at(start, follow_.max_corrections), now.tangent, step);
}

std::optional<Vector> StationMaker::tangent_ahead(const Station& now, const Vector& direction, double step) {
  const Vector there = now.at + step * direction;
  const std::shared_ptr<const steady::Problem> problem = equations_.at(there.parameter);
  if (!problem || spent(problem->budget())) return {};
  auto point = std::make_shared<steady::Point>();
  steady::evaluate(problem, there.displacement, *point);
  ++jacobians_;
  ++evaluations_;
  if (point->status == Status::not_finite) return {};
  steady::differentiate(*point);
  const steady::Tangent tangent(std::move(point));
  const Direction found = equations_.direction(tangent, direction, now.metric);
  if (found.status != Status::converged) return {};
  Vector result = now.metric.unit(found.direction);
  const int here = tangent.factors().determinant_sign() * (result.parameter > 0 ? 1 : -1);
  if (here != 0 && now.orientation != 0 && here != now.orientation) result = -1 * result;
  return result;
}

std::optional<Station> StationMaker::described(const Station& now, const Equations::Correction& found,
                                               const Vector& direction, double step) {
  jacobians_ += found.iterations;
  evaluations_ += found.evaluations;
  failure_ = found.status;
  if (found.status != Status::converged) return {};
  // Further away it is another branch, or the other side of a loop; very near, the way on behind a kink.
  constexpr CorrectorParams kParams;
  const Vector way = found.at - now.at;
  const double reached = now.metric.length(way);
  failure_ = Status::stalled;
  if (reached > std::max(kParams.sidestep * step, kParams.kink * follow_.largest_change)) return {};
  Equations::Described point = equations_.describe(found, direction, now.metric);
  failure_ = point.state.status;
  if (point.state.status != Status::converged || !point.tangent) return {};
  const Direction next = equations_.direction(*point.tangent, direction, now.metric);
  failure_ = next.status;
  if (next.status != Status::converged) return {};
  Station result;
  result.at = found.at;
  result.state = std::move(point.state);
  result.step = reached;
  result.output_change = output_change(now.state, result.state);
  result.iterations = found.iterations;
  result.metric = metric_at(result.state);
  result.tangent = result.metric.unit(next.direction);
  orient(now, way, point.tangent->factors().determinant_sign(), result);
  const double cosine = now.metric.inner(now.tangent, result.tangent) / now.metric.length(result.tangent);
  result.turn_angle = std::acos(std::clamp(cosine, -1.0, 1.0));
  return result;
}

double StationMaker::output_change(const steady::State& before, const steady::State& after) const {
  if (after.outputs.size() == 0) return 0;
  const double size =
      std::max({vibration(before.outputs), vibration(after.outputs), MetricParams{}.floor * largest_output_});
  return size > 0 ? (after.outputs - before.outputs).norm() / size : 0;
}

}  // namespace dovetail::branches
