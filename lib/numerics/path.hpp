#pragma once

#include <Eigen/Core>
#include <functional>

#include "core/status.hpp"

namespace dovetail::numerics {

struct PathParams {
  double tolerance = 1e-9;      ///< on the Euclidean norm of the (scaled) residual, > 0
  int max_jacobians = 1000;     ///< >= 1
  double first_step = 0.01;     ///< of arc length, > 0
  double longest_step = 0.3;    ///< relative to 1 + |y|, > 0
  double shortest_step = 1e-7;  ///< relative to 1 + |y|: below it there is a kink, > 0
};

struct PathStats {
  Status status = Status::iteration_limit;  ///< converged: arrived; stalled: lost at a kink; singular
  int jacobians = 0, evaluations = 0;
};

/// r(x, s) = 0, n equations in y = (x, s), all scaled to O(1).
struct PathSystem {
  /// r [n] at y [n+1]; sets y as the current point.
  std::function<Eigen::VectorXd(const Eigen::VectorXd& y)> residual;
  /// d r / d y [n, n+1] at the current point.
  std::function<Eigen::MatrixXd()> jacobian;
  /// The path crosses s = 1 near x: true ends the search, false refines the crossing.
  std::function<bool(const Eigen::VectorXd& x)> arrive;
};

/// Follows the curve r(x, s) = 0 from `y`, a point of it with s < 1, towards growing s and through all its turns until
/// it crosses s = 1. For equations that are only piecewise smooth: along such a curve the sign of
/// det [dr/dy; t^T] is the same on every piece [Allgower & Georg 1990], so the tangent t is oriented by it, also where
/// the curve turns back sharply at a kink and no angle tells which way is on. Where no step across a kink converges,
/// the tangent of the piece beyond it is taken. Cost: a dense LU of size n+1 per Jacobian.
PathStats follow_path(const PathSystem& system, Eigen::VectorXd y, const PathParams& params = {});

}  // namespace dovetail::numerics
