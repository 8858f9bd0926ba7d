#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "steady/jacobian.hpp"
#include "steady/problem.hpp"

namespace dovetail::steady {

/// A point U of a problem with everything the march says of it. J = Z + D (eps I - Z) comes in nodal blocks: D is
/// block-diagonal over nodes, Z over harmonics, and no product of full size is ever formed.
struct Point {
  std::shared_ptr<const Problem> problem;
  Eigen::MatrixXd displacement;             ///< U [nc, 2H+1], m
  Eigen::MatrixXd prediction;               ///< lambda_u [nc, 2H+1], N
  Eigen::MatrixXd force;                    ///< lambda [nc, 2H+1], N
  Eigen::MatrixXd residual;                 ///< f = Z U + lambda - F [nc, 2H+1], N
  std::vector<contact::MarchResult> nodes;  ///< [Nc]; differentiate() fills the blocks D
  bool has_derivative = false;
  Status status = Status::converged;  ///< converged, not_periodic or not_finite

  /// Norm of f relative to the excitation.
  [[nodiscard]] double error() const { return residual.norm() / problem->system().force_scale; }
};

/// Evaluates f at U [nc, 2H+1] into `point`, whose storage is used again. O(nc^2 H + Nc N).
void evaluate(std::shared_ptr<const Problem> problem, const Eigen::MatrixXd& displacement, Point& point);
/// Adds the nodal blocks D, unless they are there. O(Nc N m d), m = d (2H+1).
void differentiate(Point& point);

// Of a point with its derivative:

/// Z, D and eps of all nodes; views of the point.
[[nodiscard]] JacobianBlocks blocks(const Point& point);
/// The full Jacobian [nc (2H+1)]^2 over vec(U). O(n^2 d), n = nc (2H+1). The budget counts its factorisation, too.
[[nodiscard]] Eigen::MatrixXd jacobian(const Point& point);
/// D applied to a change of lambda_u, and J to a change of U, both [nc, 2H+1], without forming J. O(nc^2 H).
[[nodiscard]] Eigen::MatrixXd apply_force_derivative(const Point& point, const Eigen::MatrixXd& change);
[[nodiscard]] Eigen::MatrixXd apply_jacobian(const Point& point, const Eigen::MatrixXd& change);
/// Derivative of what each node wears per cycle by what it predicts, lambda_u: [d, 2H+1] per node.
[[nodiscard]] std::vector<Eigen::MatrixXd> wear_rate_by_prediction(const Point& point);
/// df/dw = (I - D)(dZ/dw U - dF/dw) [nc, 2H+1], N s.
[[nodiscard]] Eigen::MatrixXd residual_to_frequency(const Point& point);

/// What is left of forces after cancellation, relative to the excitation: no smaller residual can be asked for here.
[[nodiscard]] double rounding_floor(const Point& point);
/// The residual that a solution near this point must reach: `tolerance`, or the floor where that is more.
[[nodiscard]] double attainable(const Point& point, double tolerance);

/// Whether the contact holds the body in its slot: the static stiffness with the nodes closed and stuck that carry load
/// must not have a negative direction. Spin softening gives a floating blade roots of the equations far away from its
/// slot (K regular but indefinite, all nodes open, or hanging at the end of one flank): the residual vanishes there,
/// but they are no states the blade can be in. Where K allows for them none with a wide opening is held.
[[nodiscard]] bool is_held(const Point& point);

}  // namespace dovetail::steady
