#include "numerics/sparse_modes.hpp"

#include <Spectra/SymGEigsShiftSolver.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <type_traits>

namespace dovetail::numerics {

namespace {

template <class Scalar>
using Column = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;
template <class Scalar>
using Columns = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

// A complex vector of n numbers is, as stored, a real vector of 2n; in it a Hermitian matrix acts as a real
// symmetric one, so the same real Lanczos process serves both cases.
template <class Scalar>
constexpr Eigen::Index kReals = std::is_same_v<Scalar, double> ? 1 : 2;

template <class ScalarT>
class ShiftedInverse {
 public:
  using Scalar = double;
  explicit ShiftedInverse(const SparseCholesky<ScalarT>& cholesky) : cholesky_(cholesky) {}
  Eigen::Index rows() const { return kReals<ScalarT> * cholesky_.size(); }
  Eigen::Index cols() const { return rows(); }
  void set_shift(double) {}  // the factorisation already contains it
  void perform_op(const double* in, double* out) const {
    cholesky_.solve(reinterpret_cast<const ScalarT*>(in), reinterpret_cast<ScalarT*>(out));
  }

 private:
  const SparseCholesky<ScalarT>& cholesky_;
};

template <class ScalarT>
class MassProduct {
 public:
  using Scalar = double;
  explicit MassProduct(const Eigen::SparseMatrix<ScalarT>& mass) : mass_(mass) {}
  Eigen::Index rows() const { return kReals<ScalarT> * mass_.rows(); }
  Eigen::Index cols() const { return rows(); }
  void perform_op(const double* in, double* out) const {
    const Eigen::Map<const Column<ScalarT>> x(reinterpret_cast<const ScalarT*>(in), mass_.cols());
    Eigen::Map<Column<ScalarT>> y(reinterpret_cast<ScalarT*>(out), mass_.rows());
    y.noalias() = mass_ * x;
  }

 private:
  const Eigen::SparseMatrix<ScalarT>& mass_;
};

// Factorises K - sigma M, lowering sigma until it is positive definite.
template <class Scalar>
Status factorise_shifted(const Eigen::SparseMatrix<Scalar>& stiffness, const Eigen::SparseMatrix<Scalar>& mass,
                         double& shift, SparseCholesky<Scalar>& cholesky) {
  const auto factorise = [&] {
    Status result = Status::singular;
    if (shift == 0) {
      result = cholesky.factorise(stiffness);
    } else {
      const Eigen::SparseMatrix<Scalar> shifted = stiffness - Scalar(shift) * mass;
      result = cholesky.factorise(shifted);
    }
    // A singular matrix may pass with pivots of rounding size; its inverse would drown the other modes.
    if (result == Status::converged && cholesky.reciprocal_condition() < 1e-14) return Status::singular;
    return result;
  };
  Status status = factorise();
  if (status != Status::singular) return status;
  double largest = 0;
  for (Eigen::Index i = 0; i < mass.rows(); ++i)
    if (std::abs(mass.coeff(i, i)) > 0)
      largest = std::max(largest, std::abs(stiffness.coeff(i, i)) / std::abs(mass.coeff(i, i)));
  double lowered = std::min(-1e-10 * largest, -std::abs(shift));
  for (int attempt = 0; attempt < 5 && status == Status::singular; ++attempt, lowered *= 100) {
    shift = lowered;
    status = factorise();
  }
  return status;
}

// Keeps the first `count` vectors that are independent in the inner product of the mass, orthonormalised.
template <class Scalar>
void keep_independent(const Eigen::SparseMatrix<Scalar>& mass, const Eigen::VectorXd& eigenvalues,
                      const Columns<Scalar>& candidates, Eigen::Index count, Modes<Scalar>& modes) {
  modes.vectors.resize(candidates.rows(), count);
  modes.eigenvalues.resize(count);
  Columns<Scalar> weighted(candidates.rows(), count);  // M times the vectors kept
  Eigen::Index kept = 0;
  for (Eigen::Index k = 0; k < candidates.cols() && kept < count; ++k) {
    Column<Scalar> v = candidates.col(k);
    for (int pass = 0; pass < 2; ++pass) v -= modes.vectors.leftCols(kept) * (weighted.leftCols(kept).adjoint() * v);
    const Column<Scalar> mv = mass * v;
    const double norm = std::sqrt(std::max(0.0, std::real(v.dot(mv))));
    // The candidates have unit norm: what is left of the second of a pair is rounding, of a new mode O(1).
    if (norm < 1e-3) continue;
    modes.vectors.col(kept) = v / norm;
    weighted.col(kept) = mv / norm;
    modes.eigenvalues[kept++] = eigenvalues[k];
  }
  modes.vectors.conservativeResize(Eigen::NoChange, kept);
  modes.eigenvalues.conservativeResize(kept);
}

}  // namespace

template <class Scalar>
Modes<Scalar> smallest_modes(const Eigen::SparseMatrix<Scalar>& stiffness, const Eigen::SparseMatrix<Scalar>& mass,
                             const ModesOptions& options, SparseCholesky<Scalar>& cholesky) {
  const Eigen::Index n = stiffness.rows();
  assert(options.count >= 1 && options.count < n && mass.rows() == n);
  Modes<Scalar> modes;
  modes.shift = options.shift;
  modes.status = factorise_shifted(stiffness, mass, modes.shift, cholesky);
  if (modes.status != Status::converged) return modes;

  const Eigen::Index reals = kReals<Scalar> * n;
  const Eigen::Index wanted = std::min(kReals<Scalar> * Eigen::Index{options.count}, reals - 1);
  // Twice the wanted pairs and some more: shift-invert then mostly converges without a restart.
  const Eigen::Index space = std::min(reals, 2 * wanted + 20);
  ShiftedInverse<Scalar> inverse(cholesky);
  MassProduct<Scalar> product(mass);
  Spectra::SymGEigsShiftSolver<ShiftedInverse<Scalar>, MassProduct<Scalar>, Spectra::GEigsMode::ShiftInvert> solver(
      inverse, product, wanted, space, modes.shift);
  solver.init();
  solver.compute(Spectra::SortRule::LargestAlge, options.iteration_limit, options.tolerance,
                 Spectra::SortRule::SmallestAlge);
  modes.status = solver.info() == Spectra::CompInfo::Successful      ? Status::converged
                 : solver.info() == Spectra::CompInfo::NotConverging ? Status::iteration_limit
                                                                     : Status::singular;
  if (modes.status != Status::converged) return modes;

  const Eigen::VectorXd eigenvalues = solver.eigenvalues();
  const Eigen::MatrixXd vectors = solver.eigenvectors();
  const Eigen::Map<const Columns<Scalar>> candidates(reinterpret_cast<const Scalar*>(vectors.data()), n,
                                                     vectors.cols());
  keep_independent<Scalar>(mass, eigenvalues, candidates, options.count, modes);
  if (modes.eigenvalues.size() < options.count) modes.status = Status::stalled;
  return modes;
}

template Modes<double> smallest_modes(const Eigen::SparseMatrix<double>&, const Eigen::SparseMatrix<double>&,
                                      const ModesOptions&, SparseCholesky<double>&);
template Modes<std::complex<double>> smallest_modes(const Eigen::SparseMatrix<std::complex<double>>&,
                                                    const Eigen::SparseMatrix<std::complex<double>>&,
                                                    const ModesOptions&, SparseCholesky<std::complex<double>>&);

}  // namespace dovetail::numerics
