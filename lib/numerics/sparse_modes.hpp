#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <complex>

#include "numerics/nearest_modes.hpp"
#include "numerics/sparse_factor.hpp"

namespace dovetail::numerics {

/// The modes K v = lambda M v with the smallest lambda: nearest_modes with a supernodal Cholesky factorisation.
/// K symmetric (Hermitian), M symmetric (Hermitian) positive definite.
///
/// When K - sigma M is not positive definite (a floating or spin-softened body), or only by rounding, sigma is lowered:
/// first to -1e-10 max_i K_ii/M_ii, then by factors of 100, at most five more times; `shift` reports the value used and
/// `singular` that none worked. Eigenvalues below a shift that is positive definite do not exist, so none is missed.
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
