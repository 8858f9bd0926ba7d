#pragma once

#include <Eigen/Core>
#include <memory>

#include "steady/tangent.hpp"

namespace dovetail::steady {

/// One attempt to solve f(U) = 0 with one method, pseudo-penalty and start.
struct Attempt {
  Status status = Status::iteration_limit;
  int iterations = 0;                           ///< Jacobians
  int evaluations = 0;                          ///< residuals
  double residual = 0;                          ///< |f| / force scale
  Point point = {};                             ///< the best one
  std::shared_ptr<const Tangent> tangent = {};  ///< the last one factorised on the way, or null
};

enum class Method { newton, powell, powell_fd };

/// Solves from `start` U [nc, 2H+1] to the tolerance of the problem's options, relative to the excitation; it is raised
/// to what rounding of the forces leaves when that is more. `reuse`, of a nearby point with the same pseudo-penalty,
/// may spare the first factorisations; it changes the way to the solution and not the solution.
[[nodiscard]] Attempt solve(const std::shared_ptr<const Problem>& problem, const Eigen::MatrixXd& start, Method method,
                            int max_iterations, const std::shared_ptr<const Tangent>& reuse = {});

}  // namespace dovetail::steady
