#include "numerics/dense_general.hpp"

#include <lapacke.h>

#include <cassert>
#include <cmath>

namespace dovetail::numerics {

Eigenvalues eigenvalues(Eigen::MatrixXd matrix) {
  const auto n = static_cast<lapack_int>(matrix.rows());
  assert(matrix.cols() == n);
  if (!matrix.allFinite()) return {.status = Status::not_finite, .values = {}};
  if (n == 0) return {};
  Eigen::VectorXd real(n), imaginary(n);
  if (LAPACKE_dgeev(LAPACK_COL_MAJOR, 'N', 'N', n, matrix.data(), n, real.data(), imaginary.data(), nullptr, 1, nullptr,
                    1) != 0)
    return {.status = Status::stalled, .values = {}};
  Eigenvalues result{.status = Status::converged, .values = Eigen::VectorXcd(n)};
  result.values.real() = real;
  result.values.imag() = imaginary;
  return result;
}

Eigen::MatrixXd least_squares(Eigen::MatrixXd a, const Eigen::MatrixXd& b, double threshold) {
  assert(a.rows() == b.rows());
  const auto m = static_cast<lapack_int>(a.rows()), n = static_cast<lapack_int>(a.cols()),
             columns = static_cast<lapack_int>(b.cols()), longest = std::max(m, n);
  Eigen::MatrixXd x = Eigen::MatrixXd::Zero(longest, columns);
  x.topRows(m) = b;
  std::vector<lapack_int> pivots(static_cast<std::size_t>(n), 0);
  lapack_int rank = 0;
  if (m > 0 && n > 0 && columns > 0)
    LAPACKE_dgelsy(LAPACK_COL_MAJOR, m, n, columns, a.data(), m, x.data(), longest, pivots.data(), threshold, &rank);
  return x.topRows(n);
}

std::vector<Eigen::Index> independent_columns(Eigen::MatrixXd matrix, double threshold) {
  const auto m = static_cast<lapack_int>(matrix.rows()), n = static_cast<lapack_int>(matrix.cols());
  std::vector<lapack_int> pivots(static_cast<std::size_t>(n), 0);
  std::vector<double> scales(pivots.size());
  std::vector<Eigen::Index> kept;
  if (m == 0 || n == 0) return kept;
  LAPACKE_dgeqp3(LAPACK_COL_MAJOR, m, n, matrix.data(), m, pivots.data(), scales.data());
  const Eigen::VectorXd left = matrix.diagonal().cwiseAbs();
  for (Eigen::Index k = 0; k < left.size(); ++k)
    if (left(k) > threshold * left(0)) kept.push_back(pivots[static_cast<std::size_t>(k)] - 1);
  return kept;
}

}  // namespace dovetail::numerics
