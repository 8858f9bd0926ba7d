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
  /// >= 0. Vectors that block_modes solves for at once: about twice as fast as single ones (0), but an eigenvalue of a
  /// multiplicity above it may be missed. From 30 000 unknowns on there are 16 at least.
  int block = 0;
};

template <class Scalar>
struct Modes {
  Status status = Status::iteration_limit;
  Eigen::VectorXd eigenvalues;                                    ///< [count] omega^2, ascending
  Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> vectors;  ///< [n, count], V^H M V = I
  double shift = 0;                                               ///< sigma that was used
};

/// The seam to a linear solver: perform_op computes x = (K - sigma M)^{-1} b of contiguous vectors of `rows`
/// scalars. K - sigma M is symmetric (Hermitian), not necessarily positive definite. It may be a generalised
/// inverse on the M-complement of some modes: those are then not found.
template <class Scalar>
struct ShiftInverse {
  Eigen::Index rows = 0;
  std::function<void(const Scalar* b, Scalar* x)> perform_op;
  /// The same of many columns [rows, k] at once, if the solver gains by it; may be left empty.
  using Columns = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
  std::function<Columns(const Columns& b)> perform_block = {};
};

/// The `count` modes of K v = lambda M v nearest to sigma = `options.shift`, on either side, by Spectra's implicitly
/// restarted Lanczos method (Spectra::SymGEigsShiftSolver; a Hermitian problem in its real form of twice the size)
/// on (K - sigma M)^{-1} M. M is symmetric (Hermitian) positive semi-definite. Fewer modes are returned, as
/// `converged`, only when (K - sigma M)^{-1} M has no more that are not zero.
///
/// A Krylov space of one vector holds one vector of each eigenspace, so multiple eigenvalues would be missed: what
/// was found is deflated (projected out, in the inner product of M) and Spectra is run again, until the largest
/// 1/|lambda - sigma| left, to 2 %, is below those found. From a random start that bound fails only with the
/// probability that the start is nearly orthogonal to a mode. In the real form of a Hermitian problem v and i v
/// are two modes: the second is recognised and dropped, complex deflation removes both.
///
/// With a `block`, when the solver takes blocks, block_modes does it.
///
/// Start vectors are fixed: results are reproducible. Cost: some 3 to 6 solves per mode, 20 or more for the check, and
/// about five M products per solve. Up to 200 unknowns, or when more than a third of the modes are wanted: a dense
/// decomposition, O(n^3). All runs together apply the operator at most
/// 3 (vector_limit count + 40) + 1440 times, several times what is usual. Statuses: `iteration_limit` (also when
/// Spectra fails), `not_finite`.
template <class Scalar>
[[nodiscard]] Modes<Scalar> nearest_modes(const ShiftInverse<Scalar>& inverse, const Eigen::SparseMatrix<Scalar>& mass,
                                          const ModesOptions& options);

extern template Modes<double> nearest_modes(const ShiftInverse<double>&, const Eigen::SparseMatrix<double>&,
                                            const ModesOptions&);
extern template Modes<std::complex<double>> nearest_modes(const ShiftInverse<std::complex<double>>&,
                                                          const Eigen::SparseMatrix<std::complex<double>>&,
                                                          const ModesOptions&);

}  // namespace dovetail::numerics
