#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "core/status.hpp"

namespace dovetail::numerics {

/// LU factors of a square matrix, P A = L U with row pivoting (LAPACK getrf on OpenBLAS). 2/3 n^3 operations, of
/// complex numbers four times as costly.
template <class Scalar>
class LuFactors {
 public:
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
  LuFactors() = default;
  /// Takes the matrix over and factorises in place; look at status() afterwards.
  explicit LuFactors(Matrix matrix) { factorise(std::move(matrix)); }
  void factorise(Matrix matrix);

  /// converged, singular (an exact zero pivot) or not_finite.
  [[nodiscard]] Status status() const { return status_; }
  [[nodiscard]] Eigen::Index size() const { return factors_.rows(); }
  /// A X = B; B is [n, m]. Only valid when status() is converged.
  [[nodiscard]] Matrix solve(Matrix right_hand_side) const;
  /// A^T X = B.
  [[nodiscard]] Matrix solve_transposed(Matrix right_hand_side) const;
  /// Smallest over largest pivot, O(n): far above rounding, the matrix is not singular to working precision. 1 when
  /// empty.
  [[nodiscard]] double pivot_ratio() const;
  /// Sign of det A for a matrix of real numbers: -1, 1, or 0 when singular. O(n).
  [[nodiscard]] int determinant_sign() const;
  /// Estimate of 1 / (|A|_1 |A^-1|_1), O(n^2). 0 when singular, 1 for an empty matrix.
  [[nodiscard]] double reciprocal_condition() const;

 private:
  [[nodiscard]] Matrix solve_with(char transposed, Matrix right_hand_side) const;
  Matrix factors_;
  std::vector<int> pivots_;
  double one_norm_ = 0;
  Status status_ = Status::converged;
};

extern template class LuFactors<double>;
extern template class LuFactors<std::complex<double>>;
using DenseLu = LuFactors<double>;
using ComplexLu = LuFactors<std::complex<double>>;

}  // namespace dovetail::numerics
