#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <complex>
#include <memory>

#include "core/status.hpp"

namespace dovetail::numerics {

/// Supernodal Cholesky factorisation P A P^T = L L^H of a sparse symmetric (Hermitian) positive definite
/// matrix, by CHOLMOD. The symbolic analysis (fill-reducing order, supernodes) depends on the pattern
/// only and is kept: for the next matrix with the same pattern call `factorise` alone.
///
/// Scalar is double or std::complex<double>; of the matrices only the upper triangle is read. The
/// work is done by BLAS, whose number of threads is the process's business (OPENBLAS_NUM_THREADS=1).
///
///   SparseCholesky<double> cholesky;
///   cholesky.analyse(a);                                  // once per pattern
///   if (cholesky.factorise(a) != Status::converged) ...   // not positive definite
///   const Eigen::MatrixXd x = cholesky.solve(b);
template <class Scalar>
class SparseCholesky {
 public:
  using Matrix = Eigen::SparseMatrix<Scalar>;
  using Dense = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

  SparseCholesky();
  ~SparseCholesky();
  SparseCholesky(SparseCholesky&&) noexcept;
  SparseCholesky& operator=(SparseCholesky&&) noexcept;

  /// Symbolic analysis of a square, compressed matrix. Forgets an earlier factorisation.
  void analyse(const Matrix& a);
  /// The same in the order that was found for another matrix with that pattern: finding it is most of the work.
  void analyse(const Matrix& a, const SparseCholesky& ordered);

  /// Numeric factorisation of a matrix with the analysed pattern; analyses first if the pattern's size
  /// or number of non-zeros is another one. `singular` when a pivot is not positive (the matrix is not positive
  /// definite to working precision), `not_finite` when a NaN or infinity is met. Then `solve` must not be called.
  [[nodiscard]] Status factorise(const Matrix& a);

  /// x = A^{-1} b, b [n, k]: in blocks of columns that fit the cache.
  [[nodiscard]] Dense solve(const Eigen::Ref<const Dense>& b) const;

  /// The same for one contiguous vector of n scalars without allocating; x and b may be the same.
  void solve(const Scalar* b, Scalar* x) const;

  [[nodiscard]] bool factorised() const;
  [[nodiscard]] Eigen::Index size() const;
  /// Crude estimate (min L_ii / max L_ii)^2, at least the reciprocal condition number; near rounding means singular.
  [[nodiscard]] double reciprocal_condition() const;
  /// Stored entries of L: a measure of cost and memory.
  [[nodiscard]] double factor_entries() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

extern template class SparseCholesky<double>;
extern template class SparseCholesky<std::complex<double>>;

}  // namespace dovetail::numerics
