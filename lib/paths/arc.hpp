#pragma once

#include <Eigen/Core>

#include "steady/state.hpp"

namespace dovetail::paths {

/// A point or a direction in the space of displacements and frequency.
struct BranchVector {
  Eigen::MatrixXd displacement;  ///< [nc, 2H+1], m
  double omega = 0;              ///< rad/s
};
[[nodiscard]] inline BranchVector operator+(const BranchVector& a, const BranchVector& b) {
  return {.displacement = a.displacement + b.displacement, .omega = a.omega + b.omega};
}
[[nodiscard]] inline BranchVector operator-(const BranchVector& a, const BranchVector& b) {
  return {.displacement = a.displacement - b.displacement, .omega = a.omega - b.omega};
}
[[nodiscard]] inline BranchVector operator*(double factor, const BranchVector& a) {
  return {.displacement = factor * a.displacement, .omega = factor * a.omega};
}
/// Norm of what vibrates: coefficients [rows, 2H+1] without their means.
[[nodiscard]] inline double vibration(const Eigen::MatrixXd& coefficients) {
  return coefficients.rightCols(coefficients.cols() - 1).norm();
}

/// Lengths in that space: |(dU, dw)|^2 = sum (eps dU / F)^2 + (dw / w)^2, F and w chosen so that both terms are O(1).
struct ArcMetric {
  Eigen::VectorXd displacement_weight;  ///< eps / F of each contact dof [nc], 1/m
  double omega_weight = 1;              ///< 1/w, s

  [[nodiscard]] double inner(const BranchVector& a, const BranchVector& b) const;
  [[nodiscard]] double length(const BranchVector& a) const;
  [[nodiscard]] BranchVector unit(const BranchVector& a) const { return (1 / length(a)) * a; }
  /// The unit vector along the frequency alone, for displacements like those given; `sign` 1 upwards.
  [[nodiscard]] BranchVector forwards(const Eigen::MatrixXd& like, double sign = 1) const;
  /// The linear form <a, .> as a row over vec(U) and its entry for the frequency.
  struct Row {
    Eigen::VectorXd displacement;
    double omega = 0;
  };
  [[nodiscard]] Row row(const BranchVector& a) const;
};

/// Penalty forces eps U of the contact [nc, 2H+1], N, and the size F of what vibrates in the contact, N.
[[nodiscard]] Eigen::MatrixXd penalty_forces(const steady::Summary& state);
[[nodiscard]] double vibrating_force(const steady::Summary& state);
/// One unit is a change of the contact's penalty forces by `force` (N), or of the frequency by `omega` (rad/s).
[[nodiscard]] ArcMetric arc_metric(const steady::Summary& state, double force, double omega);

}  // namespace dovetail::paths
