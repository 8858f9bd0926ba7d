#include "branches/branch.hpp"

#include <limits>

#include "branches/bordered.hpp"
#include "branches/params.hpp"
#include "numerics/newton.hpp"
#include "steady/solve.hpp"

namespace dovetail::branches {
namespace {

// Newton's unknowns are the coordinates in which the metric is the Euclidean one, its residuals forces relative to the
// excitation at the start and the distance from the plane.
class PlaneEquations {
 public:
  PlaneEquations(const Equations& branch, const Vector& start, const Vector& row, const ArcMetric& metric)
      : branch_(branch),
        start_(start),
        metric_(metric),
        weight_(metric.displacement_weight.replicate(start.displacement.cols(), 1)),
        row_(metric.row(row)) {}

  [[nodiscard]] Vector point(const Eigen::VectorXd& z) const {
    const Eigen::VectorXd u = z.head(weight_.size()).cwiseQuotient(weight_);
    return {.displacement = u.reshaped(start_.displacement.rows(), start_.displacement.cols()),
            .parameter = z(weight_.size()) / metric_.parameter_weight};
  }
  [[nodiscard]] Eigen::VectorXd coordinates(const Vector& point) const {
    Eigen::VectorXd z(weight_.size() + 1);
    z << weight_.cwiseProduct(point.displacement.reshaped()), metric_.parameter_weight * point.parameter;
    return z;
  }

  // Goes to a point; false where the problem cannot be set up.
  bool go_to(const Vector& now) {
    const bool same_problem = problem_ && now.parameter == parameter_;
    if (same_problem && at_->displacement == now.displacement) return true;
    // To set the problem up is the dear part for a model of many modes, and steps at the end hardly move the parameter.
    if (!same_problem) problem_ = branch_.at(now.parameter);
    if (!problem_) return false;
    parameter_ = now.parameter;
    if (!(force_ > 0)) force_ = problem_->system().force_scale;
    if (at_.use_count() > 1) at_ = std::make_shared<steady::Point>();
    steady::evaluate(problem_, now.displacement, *at_);
    constraint_ = row_.displacement.dot((now.displacement - start_.displacement).reshaped()) +
                  row_.parameter * (now.parameter - start_.parameter);
    return true;
  }

  Eigen::VectorXd residual(const Eigen::VectorXd& z) {
    if (!go_to(point(z))) return Eigen::VectorXd::Constant(z.size(), std::numeric_limits<double>::infinity());
    Eigen::VectorXd residual(z.size());
    residual << at_->residual.reshaped() / force_, constraint_;
    return residual;
  }

  Status newton_step(Eigen::VectorXd& step) {
    if (!problem_ || at_->status == Status::not_finite) return Status::not_finite;
    if (spent(problem_->budget())) return Status::budget_spent;
    steady::differentiate(*at_);
    const steady::Tangent tangent(at_);
    if (tangent.factors().status() == Status::not_finite) return tangent.factors().status();
    const BorderedSystem bordered(tangent, branch_.slope(*at_), row_.displacement, row_.parameter);
    const BorderedSystem::Solution found = bordered.solve(-at_->residual.reshaped(), -constraint_);
    if (found.status != Status::converged) return found.status;
    step.resize(weight_.size() + 1);
    step << weight_.cwiseProduct(found.displacement), metric_.parameter_weight * found.parameter;
    return Status::converged;
  }

  [[nodiscard]] const steady::Point& at() const { return *at_; }

 private:
  const Equations& branch_;
  const Vector& start_;
  const ArcMetric& metric_;
  Eigen::VectorXd weight_;
  ArcMetric::Row row_;
  double parameter_ = 0, force_ = 0, constraint_ = 0;
  std::shared_ptr<const steady::Problem> problem_;
  std::shared_ptr<steady::Point> at_ = std::make_shared<steady::Point>();
};

}  // namespace

Equations::Equations(steady::Options options, ProblemAt problem_at, Slope slope)
    : options_(std::move(options)), problem_at_(std::move(problem_at)), slope_(std::move(slope)) {}

Equations::Equations(const steady::Joint& joint, double penalty_ratio)
    : options_(joint.options),
      problem_at_([joint, penalty_ratio](double omega) -> std::shared_ptr<const steady::Problem> {
        if (!kPositive.contains(omega)) return {};
        auto system = std::make_shared<const dynamics::HarmonicSystem>(
            dynamics::harmonic_system(*joint.model, joint.options.harmonics, omega));
        if (system->status != Status::converged) return {};
        return std::make_shared<const steady::Problem>(joint, std::move(system), penalty_ratio);
      }),
      slope_(steady::residual_to_frequency) {}

Direction Equations::direction(const steady::Tangent& tangent, const Vector& along, const ArcMetric& metric) const {
  const ArcMetric::Row row = metric.row(along);
  const BorderedSystem bordered(tangent, slope(tangent.point()), row.displacement, row.parameter);
  const BorderedSystem::Solution found = bordered.solve(Eigen::VectorXd::Zero(row.displacement.size()), 1);
  if (found.status != Status::converged) return {};
  return {.status = Status::converged, .direction = bordered.vector(found)};
}

Equations::Correction Equations::correct(const Vector& start, const Vector& row, const ArcMetric& metric,
                                         int max_iterations) const {
  PlaneEquations equations(*this, start, row, metric);
  Correction found{.status = Status::singular, .at = start};
  if (!equations.go_to(start)) return found;
  const double goal = steady::attainable(equations.at(), options().tolerance);
  Eigen::VectorXd z = equations.coordinates(start);
  const numerics::NewtonSystem system{
      .residual = [&](const Eigen::VectorXd& at) { return equations.residual(at); },
      .newton_step = [&](Eigen::VectorXd& step) { return equations.newton_step(step); }};
  const numerics::NewtonStats stats =
      numerics::newton(system, z, {.tolerance = goal, .max_iterations = max_iterations});
  found.status = stats.status;
  found.at = equations.point(z);
  found.iterations = stats.iterations;
  found.evaluations = stats.evaluations;
  if (stats.status != Status::converged) return found;
  found.status = Status::stalled;
  if (!equations.go_to(found.at)) return found;
  found.point = equations.at();
  if (!(found.point.error() <= CorrectorParams{}.slack * goal)) return found;
  found.status = steady::is_held(found.point) ? Status::converged : Status::singular;
  return found;
}

Equations::Correction Equations::correct_at(const Vector& start, int max_iterations) const {
  Correction found{.status = Status::singular, .at = start};
  const std::shared_ptr<const steady::Problem> problem = at(start.parameter);
  if (!problem) return found;
  steady::Attempt attempt = steady::solve(problem, start.displacement, steady::Method::newton, max_iterations);
  found.status = attempt.status;
  found.at.displacement = attempt.point.displacement;
  found.point = std::move(attempt.point);
  found.iterations = attempt.iterations;
  found.evaluations = attempt.evaluations;
  return found;
}

Equations::Described Equations::describe(const Correction& found, const Vector& along, const ArcMetric& metric) const {
  Described result{.state = steady::described(found.point, found.status, steady::AtSolution::linearise), .tangent = {}};
  result.state.iterations = found.iterations;
  result.state.evaluations = found.evaluations;
  result.tangent = result.state.tangent;
  if (result.state.status == Status::singular && found.status == Status::converged) {
    auto point = std::make_shared<steady::Point>(found.point);
    steady::differentiate(*point);
    auto tangent = std::make_shared<const steady::Tangent>(std::move(point));
    if (direction(*tangent, along, metric).status == Status::converged) {
      result.state.status = Status::converged;
      result.tangent = std::move(tangent);
    }
  }
  if (!options().linearise) result.state.tangent.reset();
  return result;
}

}  // namespace dovetail::branches
