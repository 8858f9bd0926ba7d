#include "numerics/dense_lu.hpp"

#include <lapacke.h>

#include <cassert>

namespace dovetail::numerics {

void DenseLu::factorise(Eigen::MatrixXd matrix) {
  assert(matrix.rows() == matrix.cols());
  factors_ = std::move(matrix);
  status_ = Status::converged;
  const auto n = static_cast<lapack_int>(factors_.rows());
  pivots_.resize(static_cast<std::size_t>(n));
  if (n == 0) return;
  one_norm_ = factors_.cwiseAbs().colwise().sum().maxCoeff();
  if (!factors_.allFinite()) {
    status_ = Status::not_finite;
    return;
  }
  const lapack_int info = LAPACKE_dgetrf_work(LAPACK_COL_MAJOR, n, n, factors_.data(), n, pivots_.data());
  if (info != 0) status_ = Status::singular;
}

Eigen::MatrixXd DenseLu::solve_with(char transposed, Eigen::MatrixXd right_hand_side) const {
  assert(status_ == Status::converged && right_hand_side.rows() == size());
  const auto n = static_cast<lapack_int>(size());
  const auto m = static_cast<lapack_int>(right_hand_side.cols());
  if (n == 0 || m == 0) return right_hand_side;
  LAPACKE_dgetrs_work(LAPACK_COL_MAJOR, transposed, n, m, factors_.data(), n, pivots_.data(), right_hand_side.data(),
                      n);
  return right_hand_side;
}

Eigen::MatrixXd DenseLu::solve(Eigen::MatrixXd right_hand_side) const {
  return solve_with('N', std::move(right_hand_side));
}

Eigen::MatrixXd DenseLu::solve_transposed(Eigen::MatrixXd right_hand_side) const {
  return solve_with('T', std::move(right_hand_side));
}

double DenseLu::pivot_ratio() const {
  if (status_ != Status::converged) return 0;
  if (size() == 0) return 1;
  const Eigen::ArrayXd pivots = factors_.diagonal().array().abs();
  return pivots.minCoeff() / pivots.maxCoeff();
}

double DenseLu::reciprocal_condition() const {
  if (status_ != Status::converged) return 0;
  if (size() == 0) return 1;
  double reciprocal = 0;
  const auto n = static_cast<lapack_int>(size());
  std::vector<double> work(static_cast<std::size_t>(4 * n));
  std::vector<lapack_int> whole(static_cast<std::size_t>(n));
  LAPACKE_dgecon_work(LAPACK_COL_MAJOR, '1', n, factors_.data(), n, one_norm_, &reciprocal, work.data(), whole.data());
  return reciprocal;
}

int DenseLu::determinant_sign() const {
  if (status_ != Status::converged) return 0;
  int sign = 1;
  for (Eigen::Index i = 0; i < size(); ++i) {
    if (factors_(i, i) < 0) sign = -sign;
    if (pivots_[static_cast<std::size_t>(i)] != static_cast<int>(i) + 1) sign = -sign;
  }
  return sign;
}

}  // namespace dovetail::numerics
