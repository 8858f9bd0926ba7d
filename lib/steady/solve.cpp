#include "steady/solve.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "numerics/newton.hpp"
#include "numerics/powell.hpp"
#include "steady/params.hpp"

namespace dovetail::steady {
namespace {

// Residuals are forces relative to the excitation; unknowns are penalty forces eps U relative to it. Both are O(1).
struct Scaled {
  const std::shared_ptr<const Problem>& problem;
  Eigen::VectorXd unit;        // displacement per unit unknown, vec(U)
  double force = 1, goal = 0;  // a residual is relative to the force
  std::shared_ptr<Point> at = std::make_shared<Point>();
  std::shared_ptr<const Tangent> last = {};  // factorised

  explicit Scaled(const std::shared_ptr<const Problem>& of)
      : problem(of), unit(of->unit_displacement()), force(of->system().force_scale) {}

  void go_to(const Eigen::VectorXd& x) {
    const Eigen::VectorXd u = unit.cwiseProduct(x);
    const Eigen::MatrixXd displacement = u.reshaped(problem->model().contact_size(), problem->basis().coefficients());
    if (at->displacement.size() > 0 && at->displacement == displacement) return;
    // A tangent may refer to the point before.
    if (at.use_count() > 1) at = std::make_shared<Point>();
    evaluate(problem, displacement, *at);
  }
  Status newton_step(Eigen::VectorXd& step) {
    if (spent(problem->budget())) return Status::budget_spent;
    differentiate(*at);
    last = std::make_shared<const Tangent>(at, last.get(), Factorise::when_needed);
    step = last->solve(-at->residual.reshaped(), forcing()).cwiseQuotient(unit);
    return last->nearest_factors().status();
  }
  // As exact as the next step can make use of: quadratic convergence, and no more than the goal.
  [[nodiscard]] double forcing() const {
    const double residual = at->error();
    return std::min(WorkParams{}.loosest_step, std::max(residual, WorkParams{}.of_goal * goal / residual));
  }
  // A factorisation of n unknowns costs n^3 operations, the residual a number of them per node, sample and direction.
  // Kept factors are worth a try where the former dominates.
  [[nodiscard]] bool pays() const {
    const auto size = static_cast<double>(last->nearest_factors().size());
    const auto marched = static_cast<double>(problem->model().contact_size() * problem->basis().samples());
    return size * size * size > WorkParams{}.march_for_chord * marched;
  }
  bool chord_step(Eigen::VectorXd& step) const {
    if (!last || last->nearest_factors().regularised() || !pays()) return false;
    step = last->nearest_factors().solve(-at->residual.reshaped()).cwiseQuotient(unit);
    return true;
  }
  Eigen::MatrixXd jacobian(const Eigen::VectorXd& x) {
    // What is not finite ends Powell's method.
    if (spent(problem->budget()))
      return Eigen::MatrixXd::Constant(x.size(), x.size(), std::numeric_limits<double>::quiet_NaN());
    go_to(x);
    differentiate(*at);
    return steady::jacobian(*at) * (unit / force).asDiagonal();
  }
};

}  // namespace

Attempt solve(const std::shared_ptr<const Problem>& problem, const Eigen::MatrixXd& start, Method method,
              int max_iterations, const std::shared_ptr<const Tangent>& reuse) {
  Scaled scaled(problem);
  if (reuse && problem->penalty() == reuse->problem().penalty() && reuse->unknowns() == problem->unknowns())
    scaled.last = reuse;
  Eigen::VectorXd x = Eigen::VectorXd(start.reshaped()).cwiseQuotient(scaled.unit);
  scaled.go_to(x);
  scaled.goal = attainable(*scaled.at, problem->options().tolerance);
  Attempt attempt;
  const auto residual = [&](const Eigen::VectorXd& at) -> Eigen::VectorXd {
    scaled.go_to(at);
    return scaled.at->residual.reshaped() / scaled.force;
  };
  if (method == Method::newton) {
    const numerics::NewtonSystem system{.residual = residual,
                                        .newton_step = [&](Eigen::VectorXd& step) { return scaled.newton_step(step); },
                                        .chord_step = [&](Eigen::VectorXd& step) { return scaled.chord_step(step); }};
    const numerics::NewtonStats stats =
        numerics::newton(system, x, {.tolerance = scaled.goal, .max_iterations = max_iterations});
    attempt.status = stats.status;
    attempt.iterations = stats.iterations;
    attempt.evaluations = stats.evaluations;
    attempt.residual = stats.residual;
  } else {
    numerics::JacobianFunction jacobian = {};
    if (method == Method::powell) jacobian = [&](const Eigen::VectorXd& at) { return scaled.jacobian(at); };
    const numerics::PowellStats stats =
        numerics::powell(residual, jacobian, x, {.tolerance = scaled.goal, .max_evaluations = 20 * max_iterations});
    attempt.status = stats.status;
    attempt.iterations = stats.jacobians;
    attempt.evaluations = stats.evaluations;
    attempt.residual = stats.residual;
  }
  scaled.go_to(x);
  attempt.tangent = std::move(scaled.last);
  attempt.point = scaled.at.use_count() > 1 ? *scaled.at : std::move(*scaled.at);
  if (attempt.status == Status::converged && !is_held(attempt.point)) {
    attempt.status = Status::singular;
    attempt.residual = std::numeric_limits<double>::infinity();
  }
  return attempt;
}

}  // namespace dovetail::steady
