#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/status.hpp"

namespace dovetail::numerics {

/// LU factors of a square matrix, P A = L U with row pivoting (LAPACK dgetrf on OpenBLAS). 2/3 n^3 operations.
class DenseLu {
 public:
  DenseLu() = default;
  /// Takes the matrix over and factorises in place; look at status() afterwards.
  explicit DenseLu(Eigen::MatrixXd matrix) { factorise(std::move(matrix)); }
  void factorise(Eigen::MatrixXd matrix);

  /// converged, singular (an exact zero pivot) or not_finite.
  [[nodiscard]] Status status() const { return status_; }
  [[nodiscard]] Eigen::Index size() const { return factors_.rows(); }
  /// A X = B; B is [n, m]. Only valid when status() is converged.
  [[nodiscard]] Eigen::MatrixXd solve(Eigen::MatrixXd right_hand_side) const;
  /// A^T X = B.
  [[nodiscard]] Eigen::MatrixXd solve_transposed(Eigen::MatrixXd right_hand_side) const;
  /// Smallest over largest pivot, O(n): far above rounding, the matrix is not singular to working precision. 1 when
  /// empty.
  [[nodiscard]] double pivot_ratio() const;
  /// Sign of det A: -1, 1, or 0 when singular. O(n).
  [[nodiscard]] int determinant_sign() const;
  /// Estimate of 1 / (|A|_1 |A^-1|_1), O(n^2). 0 when singular, 1 for an empty matrix.
  [[nodiscard]] double reciprocal_condition() const;

 private:
  [[nodiscard]] Eigen::MatrixXd solve_with(char transposed, Eigen::MatrixXd right_hand_side) const;
  Eigen::MatrixXd factors_;
  std::vector<int> pivots_;
  double one_norm_ = 0;
  Status status_ = Status::converged;
};

}  // namespace dovetail::numerics
