#include "response/solve.hpp"

#include <algorithm>
#include <limits>

#include "numerics/newton.hpp"
#include "numerics/powell.hpp"
#include "response/linearisation.hpp"
#include "response/problem.hpp"

namespace dovetail::response {
namespace {

// Residuals are forces relative to the excitation; unknowns are penalty forces eps U relative to it. Both are O(1).
struct Scaled {
  const SteadyResidual& problem;
  Eigen::VectorXd unit;  // displacement per unit unknown, vec(U)
  double force = 1;
  ResidualState state;
  std::shared_ptr<const Linearisation> last;  // factorised

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
    if (spent(problem.budget())) return Status::budget_spent;
    const Eigen::MatrixXd at = state.displacement;
    problem.evaluate(at, true, state);
    auto linear = std::make_shared<const Linearisation>(problem, state, last.get());
    if (linear->status() != Status::converged) return linear->status();
    last = std::move(linear);
    step = last->solve(-state.residual.reshaped()).cwiseQuotient(unit);
    return Status::converged;
  }
  // A factorisation of n unknowns costs n^3 operations, the residual a number of them per node, sample and direction.
  // Kept factors are worth a try where the former dominates.
  [[nodiscard]] bool pays() const {
    constexpr double kOperations = 2e3;
    const auto size = static_cast<double>(last->factorised_size());
    const auto marched = static_cast<double>(problem.model().contact_size() * problem.basis().samples());
    return size * size * size > kOperations * marched;
  }
  bool chord_step(Eigen::VectorXd& step) const {
    if (!last || last->regularised() || !pays()) return false;
    step = last->solve(-state.residual.reshaped()).cwiseQuotient(unit);
    return true;
  }
  Eigen::MatrixXd jacobian(const Eigen::VectorXd& x) {
    // What is not finite ends Powell's method.
    if (spent(problem.budget()))
      return Eigen::MatrixXd::Constant(x.size(), x.size(), std::numeric_limits<double>::quiet_NaN());
    problem.evaluate(displacement(x), true, state);
    return problem.jacobian(state) * (unit / force).asDiagonal();
  }
};

}  // namespace

Attempt solve(const SteadyResidual& residual, const Eigen::MatrixXd& start, Method method, double tolerance,
              int max_iterations, const std::shared_ptr<const Linearisation>& reuse) {
  Scaled scaled(residual);
  if (reuse && residual.penalty() == reuse->residual().penalty() && reuse->unknowns() == residual.unknowns())
    scaled.last = reuse;
  Eigen::VectorXd x = Eigen::VectorXd(start.reshaped()).cwiseQuotient(scaled.unit);
  scaled.residual(x);
  const double goal = std::max(tolerance, std::min(rounding_floor(residual, scaled.state), kLargestFloor));
  Attempt attempt;
  if (method == Method::newton) {
    const numerics::NewtonSystem system{.residual = [&](const Eigen::VectorXd& at) { return scaled.residual(at); },
                                        .newton_step = [&](Eigen::VectorXd& step) { return scaled.newton_step(step); },
                                        .chord_step = [&](Eigen::VectorXd& step) { return scaled.chord_step(step); }};
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
  attempt.linearisation = scaled.last;
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
