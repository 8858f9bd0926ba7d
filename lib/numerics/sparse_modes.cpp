#include "numerics/sparse_modes.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <random>

namespace dovetail::numerics {

namespace {

template <class Scalar>
using Column = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;
template <class Scalar>
using Columns = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

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
  for (int attempt = 0; attempt < 6 && status == Status::singular; ++attempt, lowered *= 100) {
    shift = lowered;
    status = factorise();
  }
  return status;
}

// Block Lanczos on A = (K - sigma M)^{-1} M, self-adjoint in the inner product of M: V^H M V = I and the block
// tridiagonal T = V^H M A V. Blocks meet modes of equal frequency (the rigid motions of a floating body) that a single
// starting vector would miss, and solve several right-hand sides at once. Fully reorthogonalised, never restarted.
template <class Scalar>
class BlockLanczos {
 public:
  BlockLanczos(const Eigen::SparseMatrix<Scalar>& mass, const SparseCholesky<Scalar>& cholesky, Eigen::Index capacity)
      : mass_(mass),
        cholesky_(cholesky),
        basis_(mass.rows(), std::min(mass.rows(), capacity + kBlockWidth)),
        weighted_(basis_.rows(), basis_.cols()),
        projected_(Columns<Scalar>::Zero(basis_.cols(), basis_.cols())) {
    start_block();
  }

  /// Vectors to which A has been applied.
  Eigen::Index steps() const { return first_; }
  bool complete() const { return first_ == mass_.rows(); }

  void step() {
    if (width_ == 0) start_block();
    const Eigen::Index current = first_, width = width_;
    Columns<Scalar> x = cholesky_.solve(weighted_.middleCols(current, width));
    const Columns<Scalar> diagonal = weighted_.middleCols(current, width).adjoint() * x;
    projected_.block(current, current, width, width) = 0.5 * (diagonal + diagonal.adjoint());
    scale_ = std::max(scale_, diagonal.cwiseAbs().maxCoeff());
    first_ += width;
    for (int pass = 0; pass < 2; ++pass) orthogonalise(x);
    coupling_ = append(x);
    projected_.block(first_, current, width_, width) = coupling_;
    projected_.block(current, first_, width, width_) = coupling_.adjoint();
  }

  /// Computes the Ritz pairs; true when the largest `count` have residuals below tolerance times their value.
  bool converged(Eigen::Index count, double tolerance) {
    ritz_.compute(projected_.topLeftCorner(first_, first_));
    if (ritz_.info() != Eigen::Success || first_ < count) return false;
    const Columns<Scalar> last = ritz_.eigenvectors().bottomRightCorner(coupling_.cols(), count);
    const Eigen::VectorXd residual = (coupling_ * last).colwise().norm();
    return (residual.array() <= tolerance * ritz_.eigenvalues().tail(count).array()).all();
  }

  /// Eigenvalues 1/theta + shift, ascending, and their vectors.
  void extract(Eigen::Index count, Modes<Scalar>& modes) const {
    const Columns<Scalar> chosen = ritz_.eigenvectors().rightCols(count).rowwise().reverse();
    modes.vectors.noalias() = basis_.leftCols(first_) * chosen;
    modes.eigenvalues = ritz_.eigenvalues().tail(count).reverse().cwiseInverse().array() + modes.shift;
  }

 private:
  void orthogonalise(Columns<Scalar>& x) const {
    const Columns<Scalar> overlap = weighted_.leftCols(first_).adjoint() * x;
    x.noalias() -= basis_.leftCols(first_) * overlap;
  }

  /// Appends the independent part Q of x = Q R as the next block; returns R.
  Columns<Scalar> append(Columns<Scalar>& x) {
    Columns<Scalar> r = Columns<Scalar>::Zero(x.cols(), x.cols());
    width_ = 0;
    for (Eigen::Index c = 0; c < x.cols() && first_ + width_ < basis_.cols(); ++c) {
      for (int pass = 0; pass < 2; ++pass) {
        const Column<Scalar> overlap = weighted_.middleCols(first_, width_).adjoint() * x.col(c);
        x.col(c) -= basis_.middleCols(first_, width_) * overlap;
        r.col(c).head(width_) += overlap;
      }
      const Column<Scalar> mx = mass_ * x.col(c);
      const double norm = std::sqrt(std::max(0.0, std::real(x.col(c).dot(mx))));
      if (!(norm > 1e-14 * scale_)) continue;  // its direction is complete
      basis_.col(first_ + width_) = x.col(c) / Scalar(norm);
      weighted_.col(first_ + width_) = mx / Scalar(norm);
      r(width_++, c) = norm;
    }
    return r.topRows(width_);
  }

  void start_block() {
    std::mt19937_64 random(static_cast<std::uint64_t>(first_) + 1);
    std::uniform_real_distribution<double> uniform(-1, 1);
    Columns<Scalar> start(mass_.rows(), kBlockWidth);
    for (Scalar& value : start.reshaped()) value = uniform(random);
    // One application of A damps the stiffest directions.
    Columns<Scalar> x = cholesky_.solve(start);
    x.colwise().normalize();
    for (int pass = 0; pass < 2; ++pass) orthogonalise(x);
    append(x);
  }

  static constexpr Eigen::Index kBlockWidth = 4;

  const Eigen::SparseMatrix<Scalar>& mass_;
  const SparseCholesky<Scalar>& cholesky_;
  Columns<Scalar> basis_, weighted_;  // V and M V
  Columns<Scalar> projected_;         // T
  Columns<Scalar> coupling_;          // block below the last one of T
  Eigen::SelfAdjointEigenSolver<Columns<Scalar>> ritz_;
  Eigen::Index first_ = 0, width_ = 0;  // the block to be multiplied next
  double scale_ = 0;
};

}  // namespace

template <class Scalar>
Modes<Scalar> smallest_modes(const Eigen::SparseMatrix<Scalar>& stiffness, const Eigen::SparseMatrix<Scalar>& mass,
                             const ModesOptions& options, SparseCholesky<Scalar>& cholesky) {
  assert(options.count >= 1 && options.count < stiffness.rows() && mass.rows() == stiffness.rows());
  Modes<Scalar> modes;
  modes.shift = options.shift;
  modes.status = factorise_shifted(stiffness, mass, modes.shift, cholesky);
  if (modes.status != Status::converged) return modes;

  const Eigen::Index wanted = options.count;
  const Eigen::Index capacity = Eigen::Index{options.vector_limit} * wanted + 40;
  BlockLanczos<Scalar> lanczos(mass, cholesky, capacity);
  Eigen::Index next_look = 2 * wanted;
  modes.status = Status::iteration_limit;
  while (lanczos.steps() < capacity && !lanczos.complete()) {
    lanczos.step();
    if (lanczos.steps() < next_look && !lanczos.complete()) continue;
    if (lanczos.converged(wanted, options.tolerance)) {
      modes.status = Status::converged;
      lanczos.extract(wanted, modes);
      break;
    }
    next_look = lanczos.steps() + std::max<Eigen::Index>(4, wanted / 2);
  }
  return modes;
}

template Modes<double> smallest_modes(const Eigen::SparseMatrix<double>&, const Eigen::SparseMatrix<double>&,
                                      const ModesOptions&, SparseCholesky<double>&);
template Modes<std::complex<double>> smallest_modes(const Eigen::SparseMatrix<std::complex<double>>&,
                                                    const Eigen::SparseMatrix<std::complex<double>>&,
                                                    const ModesOptions&, SparseCholesky<std::complex<double>>&);

}  // namespace dovetail::numerics
