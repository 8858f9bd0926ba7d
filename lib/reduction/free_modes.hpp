#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <cmath>

#include "core/status.hpp"
#include "numerics/partial_cholesky.hpp"
#include "reduction/params.hpp"

namespace dovetail::reduction {

/// Inverse of the stiffness of a body that may float, from its elimination down to the contact dofs. When K is singular
/// to rounding, its null vectors Phi_0 = [T; I] null(S) are taken out exactly and the inverse is that on their
/// M-complement.
class FloatingInverse {
 public:
  FloatingInverse(const numerics::PartialCholesky& stiffness, const Eigen::SparseMatrix<double>& mass);

  [[nodiscard]] Status status() const { return status_; }  ///< `singular`: S is so for other reasons than floating
  [[nodiscard]] const Eigen::MatrixXd& rigid_modes() const { return rigid_; }  ///< Phi_0 [n, k0], M-orthonormal
  [[nodiscard]] int negative() const { return negative_; }                     ///< negative eigenvalues of K
  [[nodiscard]] const Eigen::SparseMatrix<double>& mass() const { return mass_; }

  /// x = K^-1 b, b [n, k], in one block.
  [[nodiscard]] Eigen::MatrixXd apply(const Eigen::Ref<const Eigen::MatrixXd>& b) const;

 private:
  const numerics::PartialCholesky& stiffness_;
  const Eigen::SparseMatrix<double>& mass_;
  Status status_ = Status::converged;
  Eigen::MatrixXd schur_inverse_;  // pseudo-inverse of S
  Eigen::MatrixXd rigid_, mass_rigid_;
  int negative_ = 0;
};

struct FreeModes {
  Status status = Status::converged;
  Eigen::VectorXd eigenvalues;  ///< [m] (rad/s)^2, ascending
  Eigen::MatrixXd vectors;      ///< [n, m], M-orthonormal
  double first_neglected = 0;   ///< eigenvalue after the last kept one; infinite when none is left

  /// Number of modes that are not positive or far below the last one: eigenpairs to full accuracy, which are
  /// kept out of every linear system because their large responses would cancel.
  [[nodiscard]] Eigen::Index soft() const {
    return eigenvalues.size() == 0
               ? 0
               : (eigenvalues.array() <= FloatingParams{}.soft * std::abs(eigenvalues.tail(1)(0))).count();
  }
};

/// The `count` modes of K v = lambda M v nearest to lambda = 0, with all rigid and negative ones (which
/// may make it more than `count`), at most `limit`: numerics::nearest_modes on K^-1, then one inverse iteration.
/// Rigid modes are known beforehand, and the inertia of S tells how many negative ones must be found. M may be
/// singular on the contact dofs. `tolerance` bounds the residual |K^-1 M v - v / lambda| lambda, whose square is
/// the error of the eigenvalue; the softest modes are far more accurate. Statuses: `not_finite`, `iteration_limit`:
/// also when negative modes are missing among four times as many as were first asked for (or 100), as when K is
/// indefinite on massless dofs (contact stresses near the modulus), where no finite eigenvalue belongs to them.
[[nodiscard]] FreeModes free_modes(const FloatingInverse& inverse, int count, Eigen::Index limit, double tolerance);

}  // namespace dovetail::reduction
