#pragma once

#include <Eigen/Core>
#include <functional>

#include "core/status.hpp"

namespace dovetail::numerics {

/// A x = b where A can only be applied, and P, which is near it, can be solved with. x may be longer than b.
struct NearSystem {
  std::function<Eigen::VectorXd(const Eigen::VectorXd& b)> near_solve;                       ///< x = P^-1 b
  std::function<Eigen::VectorXd(const Eigen::VectorXd& x, const Eigen::VectorXd& b)> apply;  ///< A x, where P x = b
};

struct GmresOptions {
  double tolerance = 1e-10;  ///< of |b - A x| relative to |b|, > 0
  int most = 30;             ///< products with A, >= 0
};

struct GmresResult {
  Status status = Status::iteration_limit;  ///< converged, iteration_limit or not_finite
  Eigen::VectorXd x;                        ///< the best one found
  int products = 0;
  double residual = 1;  ///< |b - A x| / |b|
  /// Least stretch |A P^-1 y| / |y| of any y met, the smallest singular value of the Hessenberg matrix: next to zero
  /// where A is singular in a direction that b has. 1 before the first product.
  double least_stretch = 1;
};

/// GMRES [Saad & Schultz 1986] preconditioned from the right, so that the residual is that of the equations, without
/// restart, every direction made orthogonal twice. Where A differs from P in few directions it takes about as many
/// products. Stores two vectors per product.
[[nodiscard]] GmresResult gmres(const NearSystem& system, const Eigen::VectorXd& b, const GmresOptions& options);

}  // namespace dovetail::numerics
