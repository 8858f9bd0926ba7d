#include "numerics/sparse_modes.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "numerics/params.hpp"

namespace dovetail::numerics {

namespace {

// Factorises K - sigma M, lowering sigma until it is positive definite.
template <class Scalar>
Status factorise_shifted(const Eigen::SparseMatrix<Scalar>& stiffness, const Eigen::SparseMatrix<Scalar>& mass,
                         double& shift, SparseCholesky<Scalar>& cholesky) {
  constexpr ShiftParams kParams = {};
  const auto factorise = [&] {
    Status result = Status::singular;
    if (shift == 0) {
      result = cholesky.factorise(stiffness);
    } else {
      const Eigen::SparseMatrix<Scalar> shifted = stiffness - Scalar(shift) * mass;
      result = cholesky.factorise(shifted);
    }
    // A singular matrix may pass with pivots of rounding size; its inverse would drown the other modes.
    if (result == Status::converged && cholesky.reciprocal_condition() < kParams.singular) return Status::singular;
    return result;
  };
  Status status = factorise();
  if (status != Status::singular) return status;
  double largest = 0;
  for (Eigen::Index i = 0; i < mass.rows(); ++i)
    if (std::abs(mass.coeff(i, i)) > 0)
      largest = std::max(largest, std::abs(stiffness.coeff(i, i)) / std::abs(mass.coeff(i, i)));
  double lowered = std::min(-kParams.first * largest, -std::abs(shift));
  for (int attempt = 0; attempt < kParams.attempts && status == Status::singular;
       ++attempt, lowered *= kParams.growth) {
    shift = lowered;
    status = factorise();
  }
  return status;
}

}  // namespace

template <class Scalar>
Modes<Scalar> smallest_modes(const Eigen::SparseMatrix<Scalar>& stiffness, const Eigen::SparseMatrix<Scalar>& mass,
                             const ModesOptions& options, SparseCholesky<Scalar>& cholesky) {
  assert(options.count >= 1 && options.count < stiffness.rows() && mass.rows() == stiffness.rows());
  ModesOptions shifted = options;
  const Status status = factorise_shifted(stiffness, mass, shifted.shift, cholesky);
  if (status != Status::converged) return {.status = status, .eigenvalues = {}, .vectors = {}, .shift = shifted.shift};
  const ShiftInverse<Scalar> inverse{
      .rows = stiffness.rows(),
      .solve = [&](const typename ShiftInverse<Scalar>::Columns& b) { return cholesky.solve(b); }};
  return nearest_modes(inverse, mass, shifted);
}

template Modes<double> smallest_modes(const Eigen::SparseMatrix<double>&, const Eigen::SparseMatrix<double>&,
                                      const ModesOptions&, SparseCholesky<double>&);
template Modes<std::complex<double>> smallest_modes(const Eigen::SparseMatrix<std::complex<double>>&,
                                                    const Eigen::SparseMatrix<std::complex<double>>&,
                                                    const ModesOptions&, SparseCholesky<std::complex<double>>&);

}  // namespace dovetail::numerics
