#pragma once

#include <Eigen/Core>
#include <functional>

#include "core/status.hpp"

namespace dovetail::numerics {

struct PowellParams {
  double tolerance = 1e-9;    ///< on the Euclidean norm of the (scaled) residual, > 0
  int max_evaluations = 500;  ///< residuals (a finite-difference Jacobian counts its own n), >= 1
  double trust_factor = 100;  ///< first trust radius relative to |x|, > 0
};

struct PowellStats {
  Status status = Status::iteration_limit;
  int evaluations = 0;  ///< residuals, without those of finite-difference Jacobians
  int jacobians = 0;
  double residual = 0;  ///< norm at the returned point
};

using ResidualFunction = std::function<Eigen::VectorXd(const Eigen::VectorXd& x)>;
using JacobianFunction = std::function<Eigen::MatrixXd(const Eigen::VectorXd& x)>;

/// Hybrid Powell method (MINPACK hybrj, Eigen's HybridNonLinearSolver): a dogleg trust region with Broyden
/// updates. Unknowns must be scaled to O(1). Without a Jacobian it is estimated by forward differences whose
/// step is sqrt(eps) * max(|x_i|, 1) - MINPACK's own is relative to |x_i| alone and collapses near zero.
PowellStats powell(const ResidualFunction& residual, const JacobianFunction& jacobian, Eigen::VectorXd& x,
                   const PowellParams& params = {});

}  // namespace dovetail::numerics
