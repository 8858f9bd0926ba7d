#include "numerics/dense_symmetric.hpp"

#include <cblas.h>
#include <lapacke.h>

#include <cassert>
#include <utility>
#include <vector>

namespace dovetail::numerics {
namespace {

lapack_int decompose(char job, lapack_int n, double* a, double* values) {
  return LAPACKE_dsyevd(LAPACK_COL_MAJOR, job, 'L', n, a, n, values);
}
lapack_int decompose(char job, lapack_int n, std::complex<double>* a, double* values) {
  return LAPACKE_zheevd(LAPACK_COL_MAJOR, job, 'L', n, reinterpret_cast<lapack_complex_double*>(a), n, values);
}
lapack_int decompose(char job, lapack_int n, double* a, double* b, double* values) {
  return LAPACKE_dsygvd(LAPACK_COL_MAJOR, 1, job, 'L', n, a, n, b, n, values);
}
lapack_int decompose(char job, lapack_int n, std::complex<double>* a, std::complex<double>* b, double* values) {
  return LAPACKE_zhegvd(LAPACK_COL_MAJOR, 1, job, 'L', n, reinterpret_cast<lapack_complex_double*>(a), n,
                        reinterpret_cast<lapack_complex_double*>(b), n, values);
}

template <class Scalar, class... Second>
Pairs<Scalar> decomposed(char job, Dense<Scalar> a, Second... second) {
  assert(a.rows() == a.cols());
  const auto n = static_cast<lapack_int>(a.rows());
  if (!a.allFinite() || !(second.allFinite() && ...))
    return {.status = Status::not_finite, .values = {}, .vectors = Dense<Scalar>(n, 0)};
  Eigen::VectorXd values(n);
  const lapack_int info = n == 0 ? 0 : decompose(job, n, a.data(), second.data()..., values.data());
  // Of two matrices: above n the second is not positive definite.
  if (info != 0)
    return {.status = info > n ? Status::singular : Status::stalled, .values = {}, .vectors = Dense<Scalar>(n, 0)};
  if (job == 'N') a.resize(n, 0);
  return {.status = Status::converged, .values = std::move(values), .vectors = std::move(a)};
}

}  // namespace

template <class Scalar>
Pairs<Scalar> all_pairs(Dense<Scalar> matrix) {
  return decomposed('V', std::move(matrix));
}
template <class Scalar>
Pairs<Scalar> all_pairs(Dense<Scalar> a, Dense<Scalar> b) {
  return decomposed('V', std::move(a), std::move(b));
}
template <class Scalar>
Pairs<Scalar> all_values(Dense<Scalar> matrix) {
  return decomposed('N', std::move(matrix));
}
template <class Scalar>
Pairs<Scalar> all_values(Dense<Scalar> a, Dense<Scalar> b) {
  return decomposed('N', std::move(a), std::move(b));
}

template Pairs<double> all_pairs(Eigen::MatrixXd);
template Pairs<double> all_pairs(Eigen::MatrixXd, Eigen::MatrixXd);
template Pairs<double> all_values(Eigen::MatrixXd);
template Pairs<double> all_values(Eigen::MatrixXd, Eigen::MatrixXd);
template Pairs<std::complex<double>> all_pairs(Eigen::MatrixXcd);
template Pairs<std::complex<double>> all_pairs(Eigen::MatrixXcd, Eigen::MatrixXcd);
template Pairs<std::complex<double>> all_values(Eigen::MatrixXcd, Eigen::MatrixXcd);

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

DenseCholesky::DenseCholesky(Eigen::MatrixXd matrix) : factor_(std::move(matrix)) {
  const auto n = static_cast<lapack_int>(factor_.rows());
  assert(factor_.cols() == n);
  if (n == 0) return;
  one_norm_ = LAPACKE_dlansy(LAPACK_COL_MAJOR, '1', 'L', n, factor_.data(), n);
  if (LAPACKE_dpotrf(LAPACK_COL_MAJOR, 'L', n, factor_.data(), n) != 0) status_ = Status::singular;
}

Eigen::MatrixXd DenseCholesky::solve(Eigen::MatrixXd right_hand_side) const {
  const auto n = static_cast<lapack_int>(factor_.rows());
  assert(status_ == Status::converged && right_hand_side.rows() == n);
  if (right_hand_side.size() > 0)
    LAPACKE_dpotrs_work(LAPACK_COL_MAJOR, 'L', n, static_cast<lapack_int>(right_hand_side.cols()), factor_.data(), n,
                        right_hand_side.data(), n);
  return right_hand_side;
}

Eigen::MatrixXd DenseCholesky::times_inverse_upper(Eigen::MatrixXd b) const {
  const auto n = static_cast<int>(factor_.rows()), m = static_cast<int>(b.rows());
  assert(status_ == Status::converged && b.cols() == n);
  if (b.size() > 0)
    cblas_dtrsm(CblasColMajor, CblasRight, CblasLower, CblasTrans, CblasNonUnit, m, n, 1.0, factor_.data(), n, b.data(),
                m);
  return b;
}

double DenseCholesky::reciprocal_condition() const {
  if (status_ != Status::converged) return 0;
  double reciprocal = 1;
  const auto n = static_cast<lapack_int>(factor_.rows());
  if (n > 0) LAPACKE_dpocon(LAPACK_COL_MAJOR, 'L', n, factor_.data(), n, one_norm_, &reciprocal);
  return reciprocal;
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
