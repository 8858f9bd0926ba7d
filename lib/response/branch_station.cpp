#include "response/branch_station.hpp"

#include <algorithm>
#include <cmath>

namespace dovetail::response {
namespace {

double vibration(const Eigen::MatrixXd& coefficients) {
  return coefficients.rightCols(coefficients.cols() - 1).norm();
}

void reverse(BranchVector& direction) {
  direction.displacement *= -1;
  direction.omega *= -1;
}

// On a branch sign(d omega / ds) sign(det J) is constant, over turns and over kinks: where two pieces of a piecewise
// smooth f meet their Jacobians differ by a rank-one matrix along the normal of the border, so the branch crosses it
// the same way on both sides. That tells a sharp kink from a way back. It fails at a crossing with another branch,
// which goes on straight, and says the wrong thing on the middle of a fold smaller than the step: both are doubtful.
void orient(const Station& now, const BranchVector& way, int determinant, Station& next) {
  if (next.metric.inner(way, next.tangent) < 0) reverse(next.tangent);
  const int here = determinant * (next.tangent.omega > 0 ? 1 : -1);
  next.orientation = here != 0 ? here : now.orientation;
  next.doubtful = here != 0 && now.orientation != 0 && here != now.orientation;
  constexpr double kStraight = 0.9;
  const double cosine = now.metric.inner(now.tangent, next.tangent) / now.metric.length(next.tangent);
  if (!next.doubtful || cosine > kStraight) return;
  reverse(next.tangent);
  next.orientation = now.orientation;
}

}  // namespace

BranchVector difference(const BranchVector& a, const BranchVector& b) {
  return {.displacement = a.displacement - b.displacement, .omega = a.omega - b.omega};
}

BranchVector along(const BranchVector& from, const BranchVector& direction, double step) {
  return {.displacement = from.displacement + step * direction.displacement,
          .omega = from.omega + step * direction.omega};
}

BranchVector unit(const BranchVector& direction, const ArcMetric& metric) {
  const double length = metric.length(direction);
  return {.displacement = direction.displacement / length, .omega = direction.omega / length};
}

BranchVector forwards(const BranchVector& like, double omega) {
  return {.displacement = Eigen::MatrixXd::Zero(like.displacement.rows(), like.displacement.cols()), .omega = omega};
}

StationMaker::StationMaker(std::shared_ptr<const CondensedModel> model, const ContactCondition& condition,
                           const SteadyOptions& options, const ContinuationOptions& follow, double interval,
                           double penalty_ratio)
    : equations_(std::move(model), condition, options, penalty_ratio),
      follow_(follow),
      interval_(std::abs(interval)),
      linearise_(options.linearise) {}

std::optional<Station> StationMaker::first(SteadyState state, double sign) {
  Station now;
  now.at = {.displacement = state.displacement, .omega = state.omega};
  now.metric = metric_at(state);
  const TangentResult found =
      tangent(*state.linearisation, forwards(now.at, sign / now.metric.omega_weight), now.metric);
  failure_ = found.status;
  if (found.status != Status::converged) return {};
  now.tangent = unit(found.tangent, now.metric);
  now.orientation = state.linearisation->determinant_sign() * (now.tangent.omega > 0 ? 1 : -1);
  now.state = std::move(state);
  if (!linearise_) now.state.linearisation.reset();
  return now;
}

// One unit is a change of the contact's vibration by its own size, or the frequency step that counts as much.
ArcMetric StationMaker::metric_at(const SteadyState& state) {
  const CondensedModel& model = equations_.model();
  ArcMetric metric;
  metric.displacement_weight.resize(model.contact_size());
  for (Eigen::Index i = 0; i < model.nodes(); ++i) {
    metric.displacement_weight(i * model.directions()) = state.penalty.normal(i);
    metric.displacement_weight.segment(i * model.directions() + 1, model.directions() - 1)
        .setConstant(state.penalty.tangential(i));
  }
  const Eigen::MatrixXd forces = metric.displacement_weight.asDiagonal() * state.displacement;
  // Slip that is small against what the contact forces do is no reason for tiny steps, nor is an antiresonance.
  constexpr double kSlip = 0.1, kFloor = 1e-2;
  const double vibrating = std::max(vibration(forces), kSlip * vibration(state.force));
  largest_forces_ = std::max({largest_forces_, vibrating, 1e-6 * forces.norm()});
  largest_output_ = std::max(largest_output_, vibration(state.outputs));
  const double size = std::max(vibrating, kFloor * largest_forces_);
  metric.displacement_weight /= size > 0 ? size : 1.0;
  metric.omega_weight = follow_.largest_change / (follow_.largest_frequency_step * interval_);
  return metric;
}

std::optional<Station> StationMaker::advance(const Station& now, const BranchVector& direction, double step) {
  return described(now,
                   equations_.correct(along(now.at, direction, step), direction, now.metric, follow_.max_corrections),
                   direction, step);
}

std::optional<Station> StationMaker::at_frequency(const Station& now, const BranchVector& start, double step) {
  return described(now, equations_.correct_at(start, follow_.max_corrections), now.tangent, step);
}

std::optional<BranchVector> StationMaker::tangent_ahead(const Station& now, const BranchVector& direction,
                                                        double step) {
  const BranchVector there = along(now.at, direction, step);
  const std::shared_ptr<const SteadyResidual> residual = equations_.at(there.omega);
  if (!residual || spent(residual->budget())) return {};
  ResidualState state;
  residual->evaluate(there.displacement, true, state);
  ++jacobians_;
  ++evaluations_;
  if (state.status == Status::not_finite) return {};
  const Linearisation linear(*residual, std::move(state));
  const TangentResult found = tangent(linear, direction, now.metric);
  if (found.status != Status::converged) return {};
  BranchVector result = unit(found.tangent, now.metric);
  const int here = linear.determinant_sign() * (result.omega > 0 ? 1 : -1);
  if (here != 0 && now.orientation != 0 && here != now.orientation) reverse(result);
  return result;
}

std::optional<Station> StationMaker::described(const Station& now, const BranchEquations::Correction& found,
                                               const BranchVector& direction, double step) {
  jacobians_ += found.iterations;
  evaluations_ += found.evaluations;
  failure_ = found.status;
  if (found.status != Status::converged) return {};
  // Further away than twice the step it is another branch, or the other side of a loop; very near, it is the way on
  // behind a sharp kink, where contact that was stuck begins to slide.
  const BranchVector way = difference(found.point, now.at);
  const double reached = now.metric.length(way);
  failure_ = Status::stalled;
  constexpr double kSidestep = 2, kKink = 0.1;
  if (reached > std::max(kSidestep * step, kKink * follow_.largest_change)) return {};
  BranchEquations::Described point = equations_.describe(found, direction, now.metric);
  failure_ = point.state.status;
  if (point.state.status != Status::converged || !point.linear) return {};
  const TangentResult next = tangent(*point.linear, direction, now.metric);
  failure_ = next.status;
  if (next.status != Status::converged) return {};
  Station result;
  result.at = found.point;
  result.state = std::move(point.state);
  result.step = reached;
  result.output_change = output_change(now.state, result.state);
  result.iterations = found.iterations;
  result.metric = metric_at(result.state);
  result.tangent = unit(next.tangent, result.metric);
  orient(now, way, point.linear->determinant_sign(), result);
  const double cosine = now.metric.inner(now.tangent, result.tangent) / now.metric.length(result.tangent);
  result.turn_angle = std::acos(std::clamp(cosine, -1.0, 1.0));
  return result;
}

double StationMaker::output_change(const SteadyState& before, const SteadyState& after) const {
  if (after.outputs.size() == 0) return 0;
  constexpr double kFloor = 1e-2;
  const double size = std::max({vibration(before.outputs), vibration(after.outputs), kFloor * largest_output_});
  return size > 0 ? (after.outputs - before.outputs).norm() / size : 0;
}

}  // namespace dovetail::response
