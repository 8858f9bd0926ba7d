#pragma once

#include <Eigen/Core>

#include <memory>

#include "response/linearisation.hpp"
#include "response/residual.hpp"

namespace dovetail::response {

/// One attempt to solve f(U) = 0 with one method, pseudo-penalty and start.
struct Attempt {
  Status status = Status::iteration_limit;
  int iterations = 0;   ///< Jacobians
  int evaluations = 0;  ///< residuals
  double residual = 0;  ///< |f| / force scale
  Eigen::MatrixXd displacement;
  std::shared_ptr<const Linearisation> linearisation = {};  ///< the last one factorised on the way, or null
};

enum class Method { newton, powell, powell_fd };

/// `tolerance` is relative to the excitation; it is raised to what rounding of the forces leaves when that is more.
/// `reuse`, of a nearby point with the same pseudo-penalty, may spare the first factorisations; it changes the way to
/// the solution and not the solution.
[[nodiscard]] Attempt solve(const SteadyResidual& residual, const Eigen::MatrixXd& start, Method method,
                            double tolerance, int max_iterations,
                            const std::shared_ptr<const Linearisation>& reuse = {});

}  // namespace dovetail::response
