#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "core/status.hpp"
#include "numerics/sparse_factor.hpp"
#include "reduction/full_model.hpp"

namespace dovetail::reduction {

/// The stiffness of a full model split into internal and contact dofs and eliminated once:
///   K_ii = L L^T,  T = -K_ii^-1 K_ir,  S = K_rr + K_ri T.
/// K_ii is positive definite (the glued structure); all that a floating blade makes singular or indefinite
/// is in S, a small dense matrix with the inertia of K.
class ContactSolver {
 public:
  /// `singular` when K_ii is not positive definite. One factorisation and nc back-solves.
  [[nodiscard]] Status factorise(const Eigen::SparseMatrix<double>& stiffness, Eigen::Index contact_size);

  [[nodiscard]] Eigen::Index internal_size() const { return response_.rows(); }
  [[nodiscard]] Eigen::Index contact_size() const { return response_.cols(); }
  [[nodiscard]] const Eigen::MatrixXd& response() const { return response_; }              ///< T [n_i, nc]
  [[nodiscard]] const Eigen::MatrixXd& schur() const { return schur_; }                    ///< S [nc, nc]
  [[nodiscard]] const Eigen::SparseMatrix<double>& coupling() const { return coupling_; }  ///< K_ir [n_i, nc]
  [[nodiscard]] double seconds_factorisation() const { return seconds_factorisation_; }

  /// K_ii^-1 b, b [n_i, k].
  [[nodiscard]] Eigen::MatrixXd solve_internal(const Eigen::Ref<const Eigen::MatrixXd>& b) const;
  /// b_r + T^T b_i [nc, k]: loads condensed onto the contact dofs, b [n, k].
  [[nodiscard]] Eigen::MatrixXd condense(const Eigen::Ref<const Eigen::MatrixXd>& b) const;
  /// [T; I] r [n, k]: static field of contact displacements r [nc, k].
  [[nodiscard]] Eigen::MatrixXd expand(const Eigen::Ref<const Eigen::MatrixXd>& r) const;

 private:
  numerics::SparseCholesky<double> cholesky_;
  Eigen::SparseMatrix<double> coupling_;
  Eigen::MatrixXd response_, schur_;
  double seconds_factorisation_ = 0;
};

}  // namespace dovetail::reduction
