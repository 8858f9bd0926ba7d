#include "numerics/dense_lu.hpp"

#include <lapacke.h>

#include <cassert>

namespace dovetail::numerics {
namespace {

lapack_complex_double* as_lapack(std::complex<double>* x) {
  return reinterpret_cast<lapack_complex_double*>(x);
}
const lapack_complex_double* as_lapack(const std::complex<double>* x) {
  return reinterpret_cast<const lapack_complex_double*>(x);
}

lapack_int getrf(lapack_int n, double* a, lapack_int* pivots) {
  return LAPACKE_dgetrf_work(LAPACK_COL_MAJOR, n, n, a, n, pivots);
}
lapack_int getrf(lapack_int n, std::complex<double>* a, lapack_int* pivots) {
  return LAPACKE_zgetrf_work(LAPACK_COL_MAJOR, n, n, as_lapack(a), n, pivots);
}
void getrs(char transposed, lapack_int n, lapack_int m, const double* a, const lapack_int* pivots, double* b) {
  LAPACKE_dgetrs_work(LAPACK_COL_MAJOR, transposed, n, m, a, n, pivots, b, n);
}
void getrs(char transposed, lapack_int n, lapack_int m, const std::complex<double>* a, const lapack_int* pivots,
           std::complex<double>* b) {
  LAPACKE_zgetrs_work(LAPACK_COL_MAJOR, transposed, n, m, as_lapack(a), n, pivots, as_lapack(b), n);
}
void gecon(lapack_int n, const double* a, double one_norm, double* reciprocal) {
  LAPACKE_dgecon(LAPACK_COL_MAJOR, '1', n, a, n, one_norm, reciprocal);
}
void gecon(lapack_int n, const std::complex<double>* a, double one_norm, double* reciprocal) {
  LAPACKE_zgecon(LAPACK_COL_MAJOR, '1', n, as_lapack(a), n, one_norm, reciprocal);
}

}  // namespace

template <class Scalar>
void LuFactors<Scalar>::factorise(Matrix matrix) {
  assert(matrix.rows() == matrix.cols());
  factors_ = std::move(matrix);
  status_ = Status::converged;
  const auto n = static_cast<lapack_int>(factors_.rows());
  pivots_.resize(static_cast<std::size_t>(n));
  if (n == 0) return;
  one_norm_ = factors_.cwiseAbs().colwise().sum().maxCoeff();
  if (!factors_.allFinite())
    status_ = Status::not_finite;
  else if (getrf(n, factors_.data(), pivots_.data()) != 0)
    status_ = Status::singular;
}

template <class Scalar>
auto LuFactors<Scalar>::solve_with(char transposed, Matrix right_hand_side) const -> Matrix {
  assert(status_ == Status::converged && right_hand_side.rows() == size());
  if (right_hand_side.size() > 0)
    getrs(transposed, static_cast<lapack_int>(size()), static_cast<lapack_int>(right_hand_side.cols()), factors_.data(),
          pivots_.data(), right_hand_side.data());
  return right_hand_side;
}

template <class Scalar>
auto LuFactors<Scalar>::solve(Matrix right_hand_side) const -> Matrix {
  return solve_with('N', std::move(right_hand_side));
}

template <class Scalar>
auto LuFactors<Scalar>::solve_transposed(Matrix right_hand_side) const -> Matrix {
  return solve_with('T', std::move(right_hand_side));
}

template <class Scalar>
double LuFactors<Scalar>::pivot_ratio() const {
  if (status_ != Status::converged) return 0;
  if (size() == 0) return 1;
  const Eigen::ArrayXd pivots = factors_.diagonal().cwiseAbs();
  return pivots.minCoeff() / pivots.maxCoeff();
}

template <class Scalar>
double LuFactors<Scalar>::reciprocal_condition() const {
  if (status_ != Status::converged) return 0;
  double reciprocal = 1;
  if (size() > 0) gecon(static_cast<lapack_int>(size()), factors_.data(), one_norm_, &reciprocal);
  return reciprocal;
}

template <class Scalar>
int LuFactors<Scalar>::determinant_sign() const {
  if (status_ != Status::converged) return 0;
  int sign = 1;
  for (Eigen::Index i = 0; i < size(); ++i) {
    if (std::real(factors_(i, i)) < 0) sign = -sign;
    if (pivots_[static_cast<std::size_t>(i)] != static_cast<int>(i) + 1) sign = -sign;
  }
  return sign;
}

template class LuFactors<double>;
template class LuFactors<std::complex<double>>;

}  // namespace dovetail::numerics
