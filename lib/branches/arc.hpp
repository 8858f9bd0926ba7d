#pragma once

#include <Eigen/Core>

#include "steady/state.hpp"

namespace dovetail::branches {

/// A point or a direction in the space of displacements U and the parameter s of a branch.
struct Vector {
  Eigen::MatrixXd displacement;  ///< [nc, 2H+1], m
  double parameter = 0;          ///< in its own unit, rad/s for a frequency
};
[[nodiscard]] inline Vector operator+(const Vector& a, const Vector& b) {
  return {.displacement = a.displacement + b.displacement, .parameter = a.parameter + b.parameter};
}
[[nodiscard]] inline Vector operator-(const Vector& a, const Vector& b) {
  return {.displacement = a.displacement - b.displacement, .parameter = a.parameter - b.parameter};
}
[[nodiscard]] inline Vector operator*(double factor, const Vector& a) {
  return {.displacement = factor * a.displacement, .parameter = factor * a.parameter};
}
/// Norm of what vibrates: coefficients [rows, 2H+1] without their means.
[[nodiscard]] inline double vibration(const Eigen::MatrixXd& coefficients) {
  return coefficients.rightCols(coefficients.cols() - 1).norm();
}

/// Lengths in that space: |(dU, ds)|^2 = sum (eps dU / F)^2 + (ds / S)^2, F and S chosen so that both terms are O(1).
struct ArcMetric {
  Eigen::VectorXd displacement_weight;  ///< eps / F of each contact dof [nc], 1/m
  double parameter_weight = 1;          ///< 1/S

  [[nodiscard]] double inner(const Vector& a, const Vector& b) const;
  [[nodiscard]] double length(const Vector& a) const;
  [[nodiscard]] Vector unit(const Vector& a) const { return (1 / length(a)) * a; }
  /// The unit vector along the parameter alone, for displacements like those given; `sign` 1 upwards.
  [[nodiscard]] Vector forwards(const Eigen::MatrixXd& like, double sign = 1) const;
  /// The linear form <a, .> as a row over vec(U) and its entry for the parameter.
  struct Row {
    Eigen::VectorXd displacement;
    double parameter = 0;
  };
  [[nodiscard]] Row row(const Vector& a) const;
};

/// Penalty forces eps U of the contact [nc, 2H+1], N, and the size F of what vibrates in the contact, N.
[[nodiscard]] Eigen::MatrixXd penalty_forces(const steady::Summary& state);
[[nodiscard]] double vibrating_force(const steady::Summary& state);
/// One unit is a change of the contact's penalty forces by `force` (N), or of the parameter by `range`.
[[nodiscard]] ArcMetric arc_metric(const steady::Summary& state, double force, double range);

}  // namespace dovetail::branches
