#include "numerics/powell.hpp"

#include <cmath>
#include <limits>
#include <unsupported/Eigen/NonLinearOptimization>

namespace dovetail::numerics {
namespace {

struct Functor {
  using Scalar = double;
  const ResidualFunction& residual;
  const JacobianFunction& jacobian;
  Eigen::Index n;
  int jacobians = 0;

  [[nodiscard]] Eigen::Index inputs() const { return n; }
  [[nodiscard]] Eigen::Index values() const { return n; }

  int operator()(const Eigen::VectorXd& x, Eigen::VectorXd& r) const {
    r = residual(x);
    return r.allFinite() ? 0 : -1;
  }

  int df(const Eigen::VectorXd& x, Eigen::MatrixXd& j) {
    ++jacobians;
    if (jacobian) {
      j = jacobian(x);
      return j.allFinite() ? 0 : -1;
    }
    const Eigen::VectorXd base = residual(x);
    Eigen::VectorXd moved = x;
    j.resize(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const double h = std::sqrt(std::numeric_limits<double>::epsilon()) * std::max(std::abs(x(i)), 1.0);
      moved(i) = x(i) + h;
      j.col(i) = (residual(moved) - base) / (moved(i) - x(i));
      moved(i) = x(i);
    }
    return j.allFinite() ? 0 : -1;
  }
};

Status as_status(int info) {
  using namespace Eigen::HybridNonLinearSolverSpace;
  switch (info) {
    case TooManyFunctionEvaluation:
      return Status::iteration_limit;
    case UserAsked:
      return Status::not_finite;
    default:
      return Status::stalled;
  }
}

}  // namespace

PowellStats powell(const ResidualFunction& residual, const JacobianFunction& jacobian, Eigen::VectorXd& x,
                   const PowellParams& params) {
  PowellStats stats;
  Functor functor{.residual = residual, .jacobian = jacobian, .n = x.size()};
  Eigen::HybridNonLinearSolver<Functor> solver(functor);
  solver.parameters.factor = params.trust_factor;
  solver.parameters.maxfev = params.max_evaluations;
  // The trust radius alone must not end the iteration: our stopping rule is the residual.
  solver.parameters.xtol = 4 * std::numeric_limits<double>::epsilon();
  solver.useExternalScaling = true;
  solver.diag = Eigen::VectorXd::Ones(x.size());
  Eigen::VectorXd best = x;
  double best_norm = std::numeric_limits<double>::infinity();
  if (x.size() == 0) {
    stats.status = Status::converged;
    return stats;
  }
  int info = solver.solveInit(x);
  if (info == Eigen::HybridNonLinearSolverSpace::UserAsked) {
    stats.status = Status::not_finite;
    stats.residual = std::numeric_limits<double>::quiet_NaN();
    return stats;
  }
  while (true) {
    const double norm = solver.fnorm;
    if (norm < best_norm) {
      best_norm = norm;
      best = x;
    }
    if (best_norm <= params.tolerance || info != Eigen::HybridNonLinearSolverSpace::Running) break;
    info = solver.solveOneStep(x);
  }
  x = best;
  stats.residual = best_norm;
  stats.evaluations = static_cast<int>(solver.nfev);
  stats.jacobians = functor.jacobians;
  stats.status = best_norm <= params.tolerance ? Status::converged : as_status(info);
  return stats;
}

}  // namespace dovetail::numerics
