#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "steady/point.hpp"

namespace dovetail::wear {

/// A point of the equations of an implicit stage, f(U; W) = 0 and g = W - B - c r(U, W) = 0, linear about it. What a
/// node wears hangs on its own prediction p = (eps I - Z) U - eps_N W e_0 alone, dr = rho . dp, so that W is eliminated
/// node by node,
///   dW = (c rho . q - g) / m,  q = (eps I - Z) dU,  m = 1 + c eps_N rho_0,
/// and what is left has the form of the Jacobian of a steady state, Z + D M (eps I - Z), M = I - c eps_N e_0 rho^T / m.
class CoupledPoint {
 public:
  /// Of a point with its derivative; `cycles` c [Nc] >= 0.
  CoupledPoint(const steady::Point& point, const Eigen::VectorXd& cycles);

  /// The point with D M in place of D: whose Jacobian is that of both equations.
  [[nodiscard]] const std::shared_ptr<const steady::Point>& eliminated() const { return eliminated_; }
  /// Of the equations for dU, vec(U): -f - D M eps_N e_0 g, for residuals f [nc, 2H+1] N and g [Nc] m.
  [[nodiscard]] Eigen::VectorXd right_hand_side(const Eigen::MatrixXd& f, const Eigen::VectorXd& g) const;
  /// The change of depths dW [Nc] that goes with dU, vec(U).
  [[nodiscard]] Eigen::VectorXd deeper(const Eigen::VectorXd& du, const Eigen::VectorXd& g) const;

 private:
  std::shared_ptr<const steady::Point> eliminated_;
  Eigen::VectorXd cycles_;              // c [Nc]
  Eigen::VectorXd pivot_;               // m [Nc]
  std::vector<Eigen::MatrixXd> slope_;  // rho [d, 2H+1] of each node
};

}  // namespace dovetail::wear
