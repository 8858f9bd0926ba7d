#include "numerics/dense_symmetric.hpp"

#include <lapacke.h>

#include <cassert>
#include <vector>

namespace dovetail::numerics {

SymmetricPairs pairs_up_to(Eigen::MatrixXd matrix, double limit) {
  const auto n = static_cast<lapack_int>(matrix.rows());
  assert(matrix.cols() == n);
  SymmetricPairs result;
  if (n == 0) return result;
  // No eigenvalue is below minus the largest row sum.
  const Eigen::MatrixXd whole = matrix.selfadjointView<Eigen::Lower>();
  const double lowest = -1.1 * whole.cwiseAbs().colwise().sum().maxCoeff();
  if (!(limit > lowest)) {
    result.vectors.resize(n, 0);
    return result;
  }
  lapack_int found = 0;
  std::vector<lapack_int> support(2 * static_cast<std::size_t>(n));
  result.values.resize(n);
  result.vectors.resize(n, n);
  const lapack_int info = LAPACKE_dsyevr(LAPACK_COL_MAJOR, 'V', 'V', 'L', n, matrix.data(), n, lowest, limit, 0, 0, 0.0,
                                         &found, result.values.data(), result.vectors.data(), n, support.data());
  if (info != 0) return {.status = Status::stalled, .values = {}, .vectors = Eigen::MatrixXd(n, 0)};
  result.values.conservativeResize(found);
  result.vectors.conservativeResize(Eigen::NoChange, found);
  return result;
}

Status invert_positive_definite(Eigen::MatrixXd& matrix) {
  const auto n = static_cast<lapack_int>(matrix.rows());
  assert(matrix.cols() == n);
  if (n == 0) return Status::converged;
  if (LAPACKE_dpotrf_work(LAPACK_COL_MAJOR, 'L', n, matrix.data(), n) != 0 ||
      LAPACKE_dpotri_work(LAPACK_COL_MAJOR, 'L', n, matrix.data(), n) != 0)
    return Status::singular;
  matrix = Eigen::MatrixXd(matrix.selfadjointView<Eigen::Lower>());
  return matrix.allFinite() ? Status::converged : Status::not_finite;
}

}  // namespace dovetail::numerics
