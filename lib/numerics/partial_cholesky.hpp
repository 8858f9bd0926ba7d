#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <memory>

#include "core/status.hpp"
#include "numerics/elimination_order.hpp"

namespace dovetail::numerics {

/// A symmetric sparse matrix with all but its last rows and columns, the border b, eliminated:
///   A = [[L, 0], [L_b, I]] [[I, 0], [0, S]] [[L, 0], [L_b, I]]^T,  A_ii = L L^T (in a fill-reducing order),
///   S = A_bb - A_bi A_ii^-1 A_ib.
/// A_ii must be positive definite; A may be singular or indefinite, and all of that is in the dense S. Systems in A
/// take an elimination, dense algebra on the border and a substitution, whatever the size of the border:
///   x = eliminate(b), x_b := S^-1 x_b, x := substitute(x) solves A x = b;
///   with x_b := 0 in between it is [A_ii^-1 b_i; 0]; substitute([0; r]) is [-A_ii^-1 A_ib r; r].
/// Constant functions may be called from several threads.
class PartialCholesky {
 public:
  PartialCholesky();
  ~PartialCholesky();
  PartialCholesky(PartialCholesky&&) noexcept;
  PartialCholesky& operator=(PartialCholesky&&) noexcept;

  /// Only the upper triangle of `a` is read. `singular`: A_ii is not positive definite; `not_finite`.
  /// Cost: one supernodal factorisation of A (CHOLMOD) in an order with the border last.
  /// - `order`: to take it from where the pattern is the same; null: it is found anew
  [[nodiscard]] Status factorise(const Eigen::SparseMatrix<double>& a, Eigen::Index border,
                                 EliminationOrder* order = nullptr);

  [[nodiscard]] Eigen::Index size() const;
  [[nodiscard]] Eigen::Index border() const { return schur_.rows(); }
  [[nodiscard]] const Eigen::MatrixXd& schur() const { return schur_; }  ///< S [border, border]

  /// [L^-1 b_i; b_b - A_bi A_ii^-1 b_i], b [n, k]; the rows above the border in the order of elimination.
  [[nodiscard]] Eigen::MatrixXd eliminate(const Eigen::Ref<const Eigen::MatrixXd>& b) const;
  /// [L^-T (y_i - L_b^T y_b); y_b], y [n, k] as `eliminate` leaves it.
  [[nodiscard]] Eigen::MatrixXd substitute(const Eigen::Ref<const Eigen::MatrixXd>& y) const;

 private:
  struct Factor;
  std::unique_ptr<Factor> factor_;
  Eigen::MatrixXd schur_;
};

}  // namespace dovetail::numerics
