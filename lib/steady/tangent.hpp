#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <memory>
#include <vector>

#include "numerics/dense_lu.hpp"
#include "steady/point.hpp"
#include "steady/separated_nodes.hpp"

namespace dovetail::steady {

/// The factorised Jacobian J = Z + D (eps I - Z) of a point and what follows from it. All vectors over the unknowns
/// are vec(U): index k nc + a is Fourier coefficient k of contact dof a, nc (2H+1) entries.
///
/// The dense factorisation sees only what is nonlinear at this point. Rows where D is a row of the identity, to
/// rounding (normal directions that never separate, nodes that never slid, all but the mean of those that slid in
/// earlier periods only), read eps dU = -f and are eliminated; nodes without force at any time are linear and condensed
/// harmonic by harmonic. Both are exact.
class Tangent {
 public:
  /// Keeps a copy of the state and of the (shared, constant) problem. O(size of the rest ^3), unless `previous` is of
  /// the same problem with the same D, to rounding: then its factors serve again.
  explicit Tangent(std::shared_ptr<const Point> point, const Tangent* previous = nullptr);

  [[nodiscard]] Status status() const { return factors_->lu.status(); }
  [[nodiscard]] Eigen::Index unknowns() const { return problem().unknowns(); }
  [[nodiscard]] Eigen::Index factorised_size() const { return factors_->lu.size(); }
  /// Smallest one of the matrices factorised.
  [[nodiscard]] double reciprocal_condition() const {
    return std::min(factors_->lu.reciprocal_condition(), factors_->separated.reciprocal_condition());
  }
  /// reciprocal_condition() < limit (<= 1e-10), at the cost of looking at the pivots where these are far from it.
  [[nodiscard]] bool nearly_singular(double limit) const;
  /// Sign of det J, 0 when J is (nearly) singular. It changes where a branch turns back in frequency.
  [[nodiscard]] int determinant_sign() const {
    return regularised() ? 0 : factors_->separated.determinant_sign() * factors_->lu.determinant_sign();
  }
  [[nodiscard]] const Problem& problem() const { return *point_->problem; }
  [[nodiscard]] const Point& point() const { return *point_; }

  /// J X = B and J^T X = B, B [nc (2H+1), m].
  [[nodiscard]] Eigen::MatrixXd solve(const Eigen::Ref<const Eigen::MatrixXd>& rhs) const;
  [[nodiscard]] Eigen::MatrixXd solve_transposed(const Eigen::Ref<const Eigen::MatrixXd>& rhs) const;

  /// Columns of df/dW for the nodes listed: -D[:, mean normal] eps_N [Salles 2009, eq. 33-35].
  [[nodiscard]] Eigen::MatrixXd residual_to_wear(const std::vector<Eigen::Index>& nodes) const;
  /// dU = -J^-1 J_W dW, [nc, 2H+1], for a change dW [Nc] of the wear depths, m.
  [[nodiscard]] Eigen::MatrixXd response_to_wear(const Eigen::VectorXd& wear_change) const;
  /// dU/dw = -J^-1 df/dw, [nc, 2H+1].
  [[nodiscard]] Eigen::MatrixXd response_to_frequency() const;
  /// Change of the wear per cycle [Nc] for dU [nc, 2H+1] and dW [Nc] (partial derivatives).
  [[nodiscard]] Eigen::VectorXd wear_rate_change(const Eigen::MatrixXd& response_change,
                                                 const Eigen::VectorXd& wear_change) const;
  /// Total derivative of the wear per cycle of all nodes with respect to the depth of the nodes listed, through
  /// f(U; W) = 0: [Nc, nodes.size()].
  [[nodiscard]] Eigen::MatrixXd wear_rate_to_wear(const std::vector<Eigen::Index>& nodes) const;

  /// True when J was (nearly) singular and its contact was stiffened by 1e-6 to get a search direction: not usable
  /// for derivatives.
  [[nodiscard]] bool regularised() const { return factors_->regularisation > 0; }
  /// Whether the factors are those of the tangent before.
  [[nodiscard]] bool shares_factors() const { return shares_factors_; }

 private:
  struct Factors {
    SeparatedNodes separated;
    std::vector<Eigen::Index> nodes;           // kept ones
    std::vector<Eigen::Index> active, direct;  // rows of vec(U) of the kept dofs
    Eigen::VectorXd direct_diagonal;           // eps of the eliminated rows
    double regularisation = 0;
    numerics::DenseLu lu;
  };
  [[nodiscard]] std::shared_ptr<const Factors> factorise(double regularisation) const;
  [[nodiscard]] bool same_jacobian(const Tangent& other) const;
  [[nodiscard]] JacobianBlocks kept_blocks(const Factors& factors) const;

  std::shared_ptr<const Point> point_;
  std::shared_ptr<const Factors> factors_;
  bool shares_factors_ = false;
};

}  // namespace dovetail::steady
