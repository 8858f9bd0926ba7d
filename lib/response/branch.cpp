#include "response/branch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numerics/newton.hpp"
#include "response/bordered.hpp"
#include "response/problem.hpp"
#include "response/solve.hpp"

namespace dovetail::response {
namespace {

// Newton's unknowns are the coordinates in which the metric is the Euclidean one, its residuals forces relative to the
// excitation at the start and the distance from the plane.
class PlaneEquations {
 public:
  PlaneEquations(const BranchEquations& branch, const BranchVector& start, const BranchVector& row,
                 const ArcMetric& metric)
      : branch_(branch), start_(start), metric_(metric), weight_(start.displacement.size()) {
    const Eigen::Index nc = start.displacement.rows();
    for (Eigen::Index j = 0; j < weight_.size(); ++j) weight_(j) = metric.displacement_weight(j % nc);
    row_ = weight_.cwiseAbs2().cwiseProduct(row.displacement.reshaped());
    corner_ = metric.omega_weight * metric.omega_weight * row.omega;
  }

  [[nodiscard]] BranchVector point(const Eigen::VectorXd& z) const {
    const Eigen::VectorXd u = z.head(weight_.size()).cwiseQuotient(weight_);
    return {.displacement = u.reshaped(start_.displacement.rows(), start_.displacement.cols()),
            .omega = z(weight_.size()) / metric_.omega_weight};
  }
  [[nodiscard]] Eigen::VectorXd coordinates(const BranchVector& point) const {
    Eigen::VectorXd z(weight_.size() + 1);
    z << weight_.cwiseProduct(point.displacement.reshaped()), metric_.omega_weight * point.omega;
    return z;
  }

  Eigen::VectorXd residual(const Eigen::VectorXd& z) {
    const BranchVector now = point(z);
    // The condensation is the dear part for a model of many modes, and steps at the end hardly move omega.
    if (!problem_ || now.omega != problem_->system().omega) problem_ = branch_.at(now.omega);
    const double nowhere = std::numeric_limits<double>::infinity();
    if (!problem_) return Eigen::VectorXd::Constant(z.size(), nowhere);
    if (!(force_ > 0)) force_ = problem_->system().force_scale;
    problem_->evaluate(now.displacement, false, state_);
    constraint_ = row_.dot((now.displacement - start_.displacement).reshaped()) + corner_ * (now.omega - start_.omega);
    Eigen::VectorXd residual(z.size());
    residual << state_.residual.reshaped() / force_, constraint_;
    return residual;
  }

  Status newton_step(Eigen::VectorXd& step) {
    if (!problem_) return Status::not_finite;
    if (spent(problem_->budget())) return Status::budget_spent;
    const Eigen::MatrixXd at = state_.displacement;
    problem_->evaluate(at, true, state_);
    if (state_.status == Status::not_finite) return state_.status;
    const Linearisation linear(*problem_, state_);
    if (linear.status() == Status::not_finite) return linear.status();
    const BorderedSystem bordered(linear, row_, corner_);
    const BorderedSystem::Solution found = bordered.solve(-state_.residual.reshaped(), -constraint_);
    if (found.status != Status::converged) return found.status;
    step.resize(weight_.size() + 1);
    step << weight_.cwiseProduct(found.displacement), metric_.omega_weight * found.omega;
    return Status::converged;
  }

  [[nodiscard]] const std::shared_ptr<const SteadyResidual>& problem() const { return problem_; }
  [[nodiscard]] const ResidualState& state() const { return state_; }

 private:
  const BranchEquations& branch_;
  const BranchVector& start_;
  const ArcMetric& metric_;
  Eigen::VectorXd weight_, row_;
  double corner_ = 0, force_ = 0, constraint_ = 0;
  std::shared_ptr<const SteadyResidual> problem_;
  ResidualState state_;
};

}  // namespace

double ArcMetric::inner(const BranchVector& a, const BranchVector& b) const {
  const Eigen::VectorXd squares = displacement_weight.cwiseAbs2();
  return (squares.asDiagonal() * a.displacement).cwiseProduct(b.displacement).sum() +
         omega_weight * omega_weight * a.omega * b.omega;
}

double ArcMetric::length(const BranchVector& a) const {
  return std::sqrt(inner(a, a));
}

BranchEquations::BranchEquations(std::shared_ptr<const CondensedModel> model, const ContactCondition& condition,
                                 const SteadyOptions& options, double penalty_ratio)
    : model_(std::move(model)),
      condition_(condition),
      options_(options),
      penalty_ratio_(penalty_ratio),
      basis_(options.harmonics, options.samples) {}

std::shared_ptr<const SteadyResidual> BranchEquations::at(double omega) const {
  if (!kPositive.contains(omega)) return {};
  auto system = std::make_shared<const HarmonicSystem>(harmonic_system(*model_, options_.harmonics, omega));
  if (system->status != Status::converged) return {};
  return std::make_shared<const SteadyResidual>(
      steady_problem(model_, std::move(system), basis_, condition_, options_, penalty_ratio_));
}

BranchEquations::Correction BranchEquations::correct(const BranchVector& start, const BranchVector& row,
                                                     const ArcMetric& metric, int max_iterations) const {
  PlaneEquations equations(*this, start, row, metric);
  Eigen::VectorXd z = equations.coordinates(start);
  Correction found{.status = Status::singular, .point = start};
  equations.residual(z);
  if (!equations.problem()) return found;
  const double goal =
      std::max(options_.tolerance, std::min(rounding_floor(*equations.problem(), equations.state()), kLargestFloor));
  const numerics::NewtonSystem system{
      .residual = [&](const Eigen::VectorXd& at) { return equations.residual(at); },
      .newton_step = [&](Eigen::VectorXd& step) { return equations.newton_step(step); }};
  const numerics::NewtonStats stats =
      numerics::newton(system, z, {.tolerance = goal, .max_iterations = max_iterations});
  found = {.status = stats.status,
           .point = equations.point(z),
           .iterations = stats.iterations,
           .evaluations = stats.evaluations};
  if (stats.status != Status::converged) return found;
  const bool same = equations.problem() && equations.problem()->system().omega == found.point.omega;
  found.residual = same ? equations.problem() : at(found.point.omega);
  ResidualState state;
  if (found.residual) found.residual->evaluate(found.point.displacement, false, state);
  // Newton measured forces by the excitation at the start, which a pole of the glued structure may have changed.
  constexpr double kSlack = 2;
  if (found.residual) found.error = found.residual->relative_norm(state.residual);
  if (!found.residual || !(found.error <= kSlack * goal))
    found.status = Status::stalled;
  else if (!is_held(*found.residual, state))
    found.status = Status::singular;
  return found;
}

BranchEquations::Correction BranchEquations::correct_at(const BranchVector& start, int max_iterations) const {
  Correction found{.status = Status::singular, .point = start, .residual = at(start.omega)};
  if (!found.residual) return found;
  Attempt attempt = solve(*found.residual, start.displacement, Method::newton, options_.tolerance, max_iterations);
  found.status = attempt.status;
  found.point.displacement = std::move(attempt.displacement);
  found.iterations = attempt.iterations;
  found.evaluations = attempt.evaluations;
  found.error = attempt.residual;
  return found;
}

BranchEquations::Described BranchEquations::describe(const Correction& found, const BranchVector& along,
                                                     const ArcMetric& metric) const {
  Described result;
  result.state = described(*found.residual, found.point.displacement, found.status, AtSolution::linearise);
  result.state.iterations = found.iterations;
  result.state.evaluations = found.evaluations;
  result.state.penalty_ratio = penalty_ratio_;
  result.linear = result.state.linearisation;
  if (result.state.status == Status::singular && found.status == Status::converged) {
    ResidualState state;
    found.residual->evaluate(found.point.displacement, true, state);
    auto linear = std::make_shared<const Linearisation>(*found.residual, std::move(state));
    if (tangent(*linear, along, metric).status == Status::converged) {
      result.state.status = Status::converged;
      result.linear = std::move(linear);
    }
  }
  if (!options_.linearise) result.state.linearisation.reset();
  return result;
}

TangentResult tangent(const Linearisation& linear, const BranchVector& along, const ArcMetric& metric) {
  const Eigen::VectorXd squares = metric.displacement_weight.cwiseAbs2();
  const Eigen::MatrixXd row = squares.asDiagonal() * along.displacement;
  const BorderedSystem bordered(linear, row.reshaped(), metric.omega_weight * metric.omega_weight * along.omega);
  const BorderedSystem::Solution found = bordered.solve(Eigen::VectorXd::Zero(row.size()), 1);
  if (found.status != Status::converged) return {};
  return {.status = Status::converged,
          .tangent = {.displacement = found.displacement.reshaped(row.rows(), row.cols()), .omega = found.omega}};
}

}  // namespace dovetail::response
