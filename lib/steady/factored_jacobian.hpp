#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <memory>
#include <vector>

#include "numerics/dense_lu.hpp"
#include "steady/point.hpp"
#include "steady/separated_nodes.hpp"

namespace dovetail::steady {

/// The factors of J = Z + D (eps I - Z) of a point, over vec(U).
///
/// The dense factorisation sees only what is nonlinear at this point. Rows where D is a row of the identity, to
/// rounding (normal directions that never separate, nodes that never slid, all but the mean of those that slid in
/// earlier periods only), read eps dU = -f and are eliminated; nodes without force at any time are linear and condensed
/// harmonic by harmonic. Both are exact.
class FactoredJacobian {
 public:
  /// Of a point with its derivative, which is kept. O(size of the rest ^3). The factors of a point near by lend what is
  /// condensed where the same nodes are without force.
  explicit FactoredJacobian(std::shared_ptr<const Point> point, const FactoredJacobian* near = nullptr);

  [[nodiscard]] const Point& point() const { return *point_; }
  [[nodiscard]] Status status() const { return lu_.status(); }
  [[nodiscard]] Eigen::Index size() const { return lu_.size(); }
  [[nodiscard]] double operations() const { return operations_; }  ///< that they took, but for what was lent
  /// Of a product with the Jacobian of a point near by, and solving once.
  [[nodiscard]] double product_operations() const;
  /// Smallest one of the matrices factorised.
  [[nodiscard]] double reciprocal_condition() const {
    return std::min(lu_.reciprocal_condition(), separated_->reciprocal_condition());
  }
  /// reciprocal_condition() < limit (<= 1e-10), at the cost of looking at the pivots where these are far from it.
  [[nodiscard]] bool nearly_singular(double limit) const;
  /// Sign of det J, 0 when J is (nearly) singular.
  [[nodiscard]] int determinant_sign() const {
    return regularised() ? 0 : separated_->determinant_sign() * lu_.determinant_sign();
  }
  /// True when J was (nearly) singular and its contact was stiffened by 1e-6 to get a search direction: not usable
  /// for derivatives.
  [[nodiscard]] bool regularised() const { return regularisation_ > 0; }
  /// Whether they belong to a problem like that of another point, whose solution they may serve to find.
  [[nodiscard]] bool serve(const Problem& other) const;
  /// Whether they are those of another point, to rounding.
  [[nodiscard]] bool belong_to(const Point& other) const;

  /// J X = B and J^T X = B, B [nc (2H+1), m].
  [[nodiscard]] Eigen::MatrixXd solve(const Eigen::MatrixXd& rhs) const;
  [[nodiscard]] Eigen::MatrixXd solve_transposed(const Eigen::MatrixXd& rhs) const;

 private:
  void factorise(double regularisation, const FactoredJacobian* near);
  [[nodiscard]] JacobianBlocks kept_blocks() const;

  std::shared_ptr<const Point> point_;
  std::shared_ptr<const SeparatedNodes> separated_;
  std::vector<Eigen::Index> nodes_;            // kept ones
  std::vector<Eigen::Index> active_, direct_;  // rows of vec(U) of the kept dofs
  Eigen::VectorXd direct_diagonal_;            // eps of the eliminated rows
  double regularisation_ = 0, operations_ = 0;
  numerics::DenseLu lu_;
};

}  // namespace dovetail::steady
