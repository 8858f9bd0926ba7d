#pragma once

#include <Eigen/Core>
#include <complex>

#include "core/status.hpp"

// LAPACK's methods for symmetric and Hermitian matrices, of which the lower triangle is read.
namespace dovetail::numerics {

template <class Scalar>
using Dense = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

/// Eigenpairs of a symmetric (Hermitian) matrix; Scalar is double or std::complex<double>.
template <class Scalar>
struct Pairs {
  Status status = Status::converged;  ///< otherwise there are no pairs: see the functions
  Eigen::VectorXd values;             ///< [k] ascending
  Dense<Scalar> vectors;              ///< [n, k] orthonormal, or B-orthonormal
};
using SymmetricPairs = Pairs<double>;

/// All of them, by divide and conquer. `not_finite`: the matrix is not; `stalled`: LAPACK failed.
template <class Scalar>
[[nodiscard]] Pairs<Scalar> all_pairs(Dense<Scalar> matrix);
/// Of A v = lambda B v; `singular`: B is not positive definite.
template <class Scalar>
[[nodiscard]] Pairs<Scalar> all_pairs(Dense<Scalar> a, Dense<Scalar> b);
/// The same without vectors, at a fraction of the cost.
template <class Scalar>
[[nodiscard]] Pairs<Scalar> all_values(Dense<Scalar> matrix);
template <class Scalar>
[[nodiscard]] Pairs<Scalar> all_values(Dense<Scalar> a, Dense<Scalar> b);

/// Those of eigenvalues <= `limit`. LAPACK's bisection: a fifth of the cost of a full decomposition when they are few.
/// `stalled`: LAPACK failed.
[[nodiscard]] SymmetricPairs pairs_up_to(Eigen::MatrixXd matrix, double limit);

/// A = L L^T of a positive definite matrix. n^3/3 operations.
class DenseCholesky {
 public:
  explicit DenseCholesky(Eigen::MatrixXd matrix);
  /// converged, or singular: the matrix is not positive definite (or not finite).
  [[nodiscard]] Status status() const { return status_; }
  /// A X = B; B is [n, m]. Only valid when status() is converged, as all below.
  [[nodiscard]] Eigen::MatrixXd solve(Eigen::MatrixXd right_hand_side) const;
  /// B L^-T; B is [m, n].
  [[nodiscard]] Eigen::MatrixXd times_inverse_upper(Eigen::MatrixXd b) const;
  /// Estimate of 1 / (|A|_1 |A^-1|_1), O(n^2). 0 when not positive definite, 1 for an empty matrix.
  [[nodiscard]] double reciprocal_condition() const;

 private:
  Eigen::MatrixXd factor_;
  double one_norm_ = 0;
  Status status_ = Status::converged;
};

/// Replaces a positive definite matrix by its inverse. `singular`: it is not positive definite.
[[nodiscard]] Status invert_positive_definite(Eigen::MatrixXd& matrix);

}  // namespace dovetail::numerics
