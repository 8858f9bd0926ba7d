#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <complex>
#include <functional>

#include "core/status.hpp"

namespace dovetail::numerics {

struct ModesOptions {
  int count = 10;    ///< modes wanted, 1 <= count < n
  double shift = 0;  ///< sigma, (rad/s)^2: modes nearest to it; smallest_modes lowers it when it has to
  /// 1e-14..1e-4. Relative residual of 1/(lambda - sigma), whose error is smaller, mostly the square. Below 1e-10
  /// rounding brings up the second vectors of pairs, which costs further runs and gains little.
  double tolerance = 1e-9;
  int vector_limit = 10;  ///< solves allowed per mode wanted (40 more are always), >= 3
  /// >= 0. Vectors that are solved for at once: eigenvalues of a higher multiplicity may be missed. 0: see ModesParams.
  int block = 0;
};

template <class Scalar>
struct Modes {
  Status status = Status::iteration_limit;
  Eigen::VectorXd eigenvalues;                                    ///< [count] omega^2, ascending
  Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> vectors;  ///< [n, count], V^H M V = I
  double shift = 0;                                               ///< sigma that was used
};

/// The seam to a linear solver: X = (K - sigma M)^{-1} B of many columns [rows, k] at once. K - sigma M is symmetric
/// (Hermitian), not necessarily positive definite. It may be a generalised inverse on the M-complement of some modes:
/// those are then not found.
template <class Scalar>
struct ShiftInverse {
  using Columns = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
  Eigen::Index rows = 0;
  std::function<Columns(const Columns& b)> solve;
};

/// The `count` modes of K v = lambda M v nearest to sigma = `options.shift`, on either side, by a block Krylov method
/// [Golub & Underwood 1977] on (K - sigma M)^{-1} M with the restart of Stewart's Krylov-Schur method [2001] and full
/// M-orthogonalisation. M is symmetric (Hermitian) positive semi-definite. Eigenvalues of a multiplicity up to the size
/// of the block come out together. A mode is taken when its residual |(K - sigma M)^{-1} M v - theta v|_M is below
/// tolerance |theta|. Fewer modes are returned, as `converged`, only when (K - sigma M)^{-1} M has no more that are not
/// zero.
///
/// Start vectors are fixed: results are reproducible. Cost: some 3 (blocks of 4) to 7 (of 16) solves per mode, three M
/// products per block. Memory: under 4 count + 6 block vectors. At most 3 vector_limit count + 400 solves. Statuses:
/// `iteration_limit`, `not_finite`.
template <class Scalar>
[[nodiscard]] Modes<Scalar> nearest_modes(const ShiftInverse<Scalar>& inverse, const Eigen::SparseMatrix<Scalar>& mass,
                                          const ModesOptions& options);

extern template Modes<double> nearest_modes(const ShiftInverse<double>&, const Eigen::SparseMatrix<double>&,
                                            const ModesOptions&);
extern template Modes<std::complex<double>> nearest_modes(const ShiftInverse<std::complex<double>>&,
                                                          const Eigen::SparseMatrix<std::complex<double>>&,
                                                          const ModesOptions&);

}  // namespace dovetail::numerics
