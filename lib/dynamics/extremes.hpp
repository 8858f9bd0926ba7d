#pragma once

#include <Eigen/Core>

namespace dovetail::dynamics {

/// Extremes of the trigonometric polynomial a0 + sum c_j cos(j tau) + s_j sin(j tau).
struct Extremes {
  double minimum = 0, maximum = 0;
  double tau_minimum = 0, tau_maximum = 0;  ///< radians, where they are attained
  [[nodiscard]] double amplitude() const { return (maximum - minimum) / 2; }
};

/// Exact to rounding: a grid of 16 H points brackets every extreme that can be the largest, Newton refines the
/// candidates. `coefficients` [2H+1].
[[nodiscard]] Extremes extremes(const Eigen::Ref<const Eigen::VectorXd>& coefficients);

/// The basis functions [1, cos tau, sin tau, ..., sin H tau] at tau, K = 2H+1 of them.
[[nodiscard]] Eigen::VectorXd fourier_row(double tau, Eigen::Index coefficients);

}  // namespace dovetail::dynamics
