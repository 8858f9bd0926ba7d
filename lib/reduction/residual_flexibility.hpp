#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <memory>
#include <optional>

#include "core/status.hpp"
#include "numerics/dense_symmetric.hpp"
#include "numerics/partial_cholesky.hpp"
#include "reduction/boundary_basis.hpp"

namespace dovetail::reduction {

/// X = (K^-1 - Phi Lambda^-1 Phi^T) B^T: displacement to unit contact forces beyond what the basis represents. Its
/// part on the contact, G = B X, is dense and known; the rest of X is never formed, its products are back-solves.
/// The `low` first pairs of the basis must be eigenpairs (rigid, negative and soft ones): they are constrained to zero
/// instead of subtracted, so that K may be singular and nothing large cancels.
class ResidualFlexibility {
 public:
  ResidualFlexibility(std::shared_ptr<const numerics::PartialCholesky> stiffness,
                      const Eigen::SparseMatrix<double>& mass, RitzBasis basis, Eigen::Index low);

  /// `singular`: K is not positive definite on the complement of the basis.
  [[nodiscard]] Status status() const { return status_; }
  [[nodiscard]] const RitzBasis& basis() const { return basis_; }
  [[nodiscard]] const std::shared_ptr<const numerics::PartialCholesky>& factor() const { return stiffness_; }
  [[nodiscard]] const Eigen::MatrixXd& on_contact() const { return flexibility_; }  ///< G [nc, nc] m/N, symmetric

  /// Phi q + X f [n, k]; q [m, k], f [nc, k] or empty (no forces: no back-solve).
  [[nodiscard]] Eigen::MatrixXd field(const Eigen::Ref<const Eigen::MatrixXd>& q,
                                      const Eigen::Ref<const Eigen::MatrixXd>& f) const;

  /// Displacement [n, k] to loads [n, k] beyond what the basis represents: (K^-1 - Phi Lambda^-1 Phi^T) b, whose part
  /// along the low pairs is left out of b. Of contact forces, b = B^T f, it is X f.
  [[nodiscard]] Eigen::MatrixXd response(const Eigen::Ref<const Eigen::MatrixXd>& loads) const;

 private:
  std::shared_ptr<const numerics::PartialCholesky> stiffness_;
  RitzBasis basis_;
  Status status_ = Status::converged;
  Eigen::MatrixXd flexibility_;
  Eigen::MatrixXd constrained_;  // [nc, nc] displacement to unit forces with the low pairs constrained to zero
  Eigen::MatrixXd represented_;  // [m, nc] what the other pairs take of it: Lambda^-1 Phi^T B^T
  Eigen::MatrixXd inertia_;      // [n - nc, low] M Phi of the low pairs, eliminated
  Eigen::MatrixXd multiplier_;   // [low, nc] of the constraints to unit displacements
  std::optional<numerics::DenseCholesky> inertia_gram_;  // E^T E [low, low]
};

}  // namespace dovetail::reduction
