#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <complex>

#include "core/status.hpp"
#include "numerics/sparse_factor.hpp"

namespace dovetail::numerics {

struct ModesOptions {
  int count = 10;            ///< modes wanted, 1 <= count < n
  double shift = 0;          ///< sigma, (rad/s)^2: modes nearest above it; K - sigma M must be positive definite
  double tolerance = 1e-11;  ///< relative accuracy of 1/(lambda - sigma), 1e-14..1e-4
  int vector_limit = 10;     ///< Lanczos vectors allowed per mode wanted (40 more are always), >= 3
};

template <class Scalar>
struct Modes {
  Status status = Status::iteration_limit;
  Eigen::VectorXd eigenvalues;                                    ///< [count] omega^2, ascending
  Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> vectors;  ///< [n, count], V^H M V = I
  double shift = 0;                                               ///< sigma that was used
};

/// The modes K v = lambda M v with the smallest lambda, by shift-invert Lanczos on
/// (K - sigma M)^{-1} M with a supernodal Cholesky factorisation. K symmetric (Hermitian), M symmetric
/// (Hermitian) positive definite.
///
/// When K - sigma M is not positive definite (a floating or spin-softened body), or only by rounding, sigma is lowered:
/// first to -1e-10 max_i K_ii/M_ii, then by factors of 100, at most five more times; `shift` reports the value used and
/// `singular` that none worked. Eigenvalues below a shift that is positive definite do not exist, so none is missed.
///
/// Block Lanczos with full reorthogonalisation, complex where the matrices are: multiple eigenvalues (up to the block
/// width of 4) are found, and modes of a Hermitian problem do not come in pairs. Cost: one factorisation, some
/// 4 to 6 solves and M products per mode.
///
/// `cholesky` keeps the symbolic analysis between calls with the same pattern, and afterwards holds the
/// factors of K - shift M.
template <class Scalar>
[[nodiscard]] Modes<Scalar> smallest_modes(const Eigen::SparseMatrix<Scalar>& stiffness,
                                           const Eigen::SparseMatrix<Scalar>& mass, const ModesOptions& options,
                                           SparseCholesky<Scalar>& cholesky);

template <class Scalar>
[[nodiscard]] Modes<Scalar> smallest_modes(const Eigen::SparseMatrix<Scalar>& stiffness,
                                           const Eigen::SparseMatrix<Scalar>& mass, const ModesOptions& options = {}) {
  SparseCholesky<Scalar> cholesky;
  return smallest_modes(stiffness, mass, options, cholesky);
}

extern template Modes<double> smallest_modes(const Eigen::SparseMatrix<double>&, const Eigen::SparseMatrix<double>&,
                                             const ModesOptions&, SparseCholesky<double>&);
extern template Modes<std::complex<double>> smallest_modes(const Eigen::SparseMatrix<std::complex<double>>&,
                                                           const Eigen::SparseMatrix<std::complex<double>>&,
                                                           const ModesOptions&, SparseCholesky<std::complex<double>>&);

}  // namespace dovetail::numerics
