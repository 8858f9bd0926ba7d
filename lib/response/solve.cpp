#include "response/solve.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>

#include "numerics/newton.hpp"
#include "numerics/powell.hpp"
#include "response/linearisation.hpp"

namespace dovetail::response {
namespace {

// Residuals are forces relative to the excitation; unknowns are penalty forces eps U relative to it. Both are O(1).
struct Scaled {
  const SteadyResidual& problem;
  Eigen::VectorXd unit;  // displacement per unit unknown, vec(U)
  double force = 1;
  ResidualState state;

  explicit Scaled(const SteadyResidual& residual)
      : problem(residual), unit(residual.unknowns()), force(residual.system().force_scale) {
    const Eigen::Index nc = residual.model().contact_size();
    for (Eigen::Index j = 0; j < unit.size(); ++j) unit(j) = force / residual.penalty_of(j % nc);
  }
  [[nodiscard]] Eigen::MatrixXd displacement(const Eigen::VectorXd& x) const {
    const Eigen::VectorXd u = unit.cwiseProduct(x);
    return u.reshaped(problem.model().contact_size(), problem.basis().coefficients());
  }
  Eigen::VectorXd residual(const Eigen::VectorXd& x) {
    problem.evaluate(displacement(x), false, state);
    return state.residual.reshaped() / force;
  }
  Status newton_step(Eigen::VectorXd& step) {
    const Eigen::MatrixXd at = state.displacement;
    problem.evaluate(at, true, state);
    const Linearisation linear(problem, state);
    if (linear.status() != Status::converged) return linear.status();
    step = linear.solve(-state.residual.reshaped()).cwiseQuotient(unit);
    return Status::converged;
  }
  Eigen::MatrixXd jacobian(const Eigen::VectorXd& x) {
    problem.evaluate(displacement(x), true, state);
    return problem.jacobian(state) * (unit / force).asDiagonal();
  }
};

// What is left of forces after cancellation: a few units in the last place of the largest terms of f. A start at which
// rounding swamps the excitation is no measure of the forces at the solution.
double rounding_floor(const Scaled& scaled) {
  constexpr double kLargest = 1e-6;
  const double forces = scaled.problem.system().force.norm() + scaled.state.prediction.norm();
  return std::min(4e-15 * forces / scaled.force, kLargest);
}

// Whether the contact that carries load holds the body: the static stiffness with those nodes closed and stuck must not
// have a negative direction. Spin softening gives a floating blade a root of the equations far away from its slot
// (K regular but indefinite, all nodes open): the residual vanishes there, but it is no state the blade can be in.
bool is_held(const SteadyResidual& residual, const ResidualState& state) {
  Eigen::MatrixXd stiffness = residual.system().harmonics.front().stiffness.real();
  // Rounding may turn a direction without stiffness into a slightly negative one.
  constexpr double kRounding = 1e-11;
  const double shift = kRounding * stiffness.diagonal().cwiseAbs().maxCoeff();
  const Eigen::Index d = residual.model().directions();
  for (Eigen::Index i = 0; i < residual.model().nodes(); ++i) {
    const bool carries = !residual.released(i) && !state.nodes[static_cast<std::size_t>(i)].always_separated;
    for (Eigen::Index r = i * d; r < (i + 1) * d; ++r) stiffness(r, r) += carries ? residual.penalty_of(r) : shift;
  }
  return stiffness.size() == 0 || Eigen::LLT<Eigen::MatrixXd>(stiffness).info() == Eigen::Success;
}

}  // namespace

Attempt solve(const SteadyResidual& residual, const Eigen::MatrixXd& start, Method method, double tolerance,
              int max_iterations) {
  Scaled scaled(residual);
  Eigen::VectorXd x = Eigen::VectorXd(start.reshaped()).cwiseQuotient(scaled.unit);
  scaled.residual(x);
  const double goal = std::max(tolerance, rounding_floor(scaled));
  Attempt attempt;
  if (method == Method::newton) {
    const numerics::NewtonSystem system{.residual = [&](const Eigen::VectorXd& at) { return scaled.residual(at); },
                                        .newton_step = [&](Eigen::VectorXd& step) { return scaled.newton_step(step); }};
    const numerics::NewtonStats stats =
        numerics::newton(system, x, {.tolerance = goal, .max_iterations = max_iterations});
    attempt = {.status = stats.status,
               .iterations = stats.iterations,
               .evaluations = stats.evaluations,
               .residual = stats.residual,
               .displacement = {}};
  } else {
    const numerics::ResidualFunction function = [&](const Eigen::VectorXd& at) { return scaled.residual(at); };
    numerics::JacobianFunction jacobian = {};
    if (method == Method::powell) jacobian = [&](const Eigen::VectorXd& at) { return scaled.jacobian(at); };
    const numerics::PowellStats stats =
        numerics::powell(function, jacobian, x, {.tolerance = goal, .max_evaluations = 20 * max_iterations});
    attempt = {.status = stats.status,
               .iterations = stats.jacobians,
               .evaluations = stats.evaluations,
               .residual = stats.residual,
               .displacement = {}};
  }
  attempt.displacement = scaled.displacement(x);
  if (attempt.status == Status::converged) {
    residual.evaluate(attempt.displacement, false, scaled.state);
    if (!is_held(residual, scaled.state)) {
      attempt.status = Status::singular;
      attempt.residual = std::numeric_limits<double>::infinity();
    }
  }
  return attempt;
}

}  // namespace dovetail::response
