#pragma once

#include <Eigen/Core>

namespace dovetail::dynamics {

/// Complex amplitude c - i s of harmonic h of real coefficients [rows, 2H+1].
inline Eigen::VectorXcd harmonic_of(const Eigen::MatrixXd& coefficients, Eigen::Index h) {
  Eigen::VectorXcd amplitude(coefficients.rows());
  if (h == 0) {
    amplitude.real() = coefficients.col(0);
    amplitude.imag().setZero();
  } else {
    amplitude.real() = coefficients.col(2 * h - 1);
    amplitude.imag() = -coefficients.col(2 * h);
  }
  return amplitude;
}

/// Writes a complex amplitude into the columns of harmonic h.
inline void put_harmonic(const Eigen::VectorXcd& amplitude, Eigen::Index h, Eigen::MatrixXd& coefficients) {
  if (h == 0) {
    coefficients.col(0) = amplitude.real();
  } else {
    coefficients.col(2 * h - 1) = amplitude.real();
    coefficients.col(2 * h) = -amplitude.imag();
  }
}

/// The matrix of harmonic h acting on stacked (cosine, sine) coefficients: [[Re, Im], [-Im, Re]]; Re alone for h = 0.
inline Eigen::MatrixXd real_block(const Eigen::MatrixXcd& matrix, Eigen::Index h) {
  if (h == 0) return matrix.real();
  const Eigen::Index n = matrix.rows(), m = matrix.cols();
  Eigen::MatrixXd block(2 * n, 2 * m);
  block << matrix.real(), matrix.imag(), -matrix.imag(), matrix.real();
  return block;
}

}  // namespace dovetail::dynamics
