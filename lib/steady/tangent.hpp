#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "numerics/gmres.hpp"
#include "steady/factored_jacobian.hpp"
#include "steady/params.hpp"

namespace dovetail::steady {

/// When a Jacobian is factorised.
enum class Factorise {
  now,
  /// When something is asked that takes its own factors. Single right-hand sides are solved for with those of a point
  /// near by, iteratively, as long as that costs less.
  when_needed,
};

/// Partial derivatives of the wear per cycle of every node.
struct WearRateSlopes {
  Eigen::MatrixXd by_displacement;  ///< by vec(U), a column per node [nc (2H+1), Nc]
  Eigen::VectorXd by_wear;          ///< of a node by its own depth [Nc]
};

/// The Jacobian J = Z + D (eps I - Z) of a point and what follows from it. All vectors over the unknowns are vec(U):
/// index k nc + a is Fourier coefficient k of contact dof a, nc (2H+1) entries.
class Tangent {
 public:
  /// Keeps a copy of the state and of the (shared, constant) problem. `previous` lends its factors where the Jacobian
  /// is the same, to rounding, and is the point near by of Factorise::when_needed.
  explicit Tangent(std::shared_ptr<const Point> point, const Tangent* previous = nullptr,
                   Factorise when = Factorise::now);

  /// Its own factors, which are made unless they are there.
  [[nodiscard]] const FactoredJacobian& factors() const;
  /// Its own factors or those of the point near by.
  [[nodiscard]] const FactoredJacobian& nearest_factors() const { return factors_ ? *factors_ : *near_; }
  /// Whether the Jacobian is far from singular at a solution: a body that nothing holds can be moved until its residual
  /// is small. Without its own factors, by how the response to the frequency is found.
  [[nodiscard]] bool is_regular() const;
  [[nodiscard]] Eigen::Index unknowns() const { return problem().unknowns(); }
  [[nodiscard]] const Problem& problem() const { return *point_->problem; }
  [[nodiscard]] const Point& point() const { return *point_; }

  /// J X = B and J^T X = B, B [nc (2H+1), m]. NaN where the factors have failed. `tolerance`: of the residual of a
  /// solution that is found iteratively, relative to B.
  [[nodiscard]] Eigen::MatrixXd solve(const Eigen::Ref<const Eigen::MatrixXd>& rhs,
                                      double tolerance = WorkParams{}.product_tolerance) const;
  [[nodiscard]] Eigen::MatrixXd solve_transposed(const Eigen::Ref<const Eigen::MatrixXd>& rhs) const;

  /// Columns of df/dW for the nodes listed: -D[:, mean normal] eps_N [Salles 2009, eq. 33-35].
  [[nodiscard]] Eigen::MatrixXd residual_to_wear(const std::vector<Eigen::Index>& nodes) const;
  /// dU = -J^-1 J_W dW, [nc, 2H+1], for a change dW [Nc] of the wear depths, m.
  [[nodiscard]] Eigen::MatrixXd response_to_wear(const Eigen::VectorXd& wear_change) const;
  /// dU/dw = -J^-1 df/dw, [nc, 2H+1].
  [[nodiscard]] Eigen::MatrixXd response_to_frequency() const;
  [[nodiscard]] WearRateSlopes wear_rate_slopes() const;
  /// Total derivative of the wear per cycle of all nodes with respect to the depth of the nodes listed, through
  /// f(U; W) = 0: [Nc, nodes.size()].
  [[nodiscard]] Eigen::MatrixXd wear_rate_to_wear(const std::vector<Eigen::Index>& nodes) const;

  /// Whether the factors are those of the tangent before.
  [[nodiscard]] bool shares_factors() const { return shares_factors_; }

 private:
  [[nodiscard]] int most_products() const;
  [[nodiscard]] std::optional<numerics::GmresResult> solved_nearly(const Eigen::VectorXd& rhs, double tolerance) const;

  std::shared_ptr<const Point> point_;
  std::shared_ptr<const FactoredJacobian> near_;  // of a point near by; null unless factors_ is there
  // What is computed when it is first asked for. A tangent belongs to one thread.
  mutable std::shared_ptr<const FactoredJacobian> factors_;
  mutable Eigen::VectorXd by_frequency_;
  bool shares_factors_ = false;
};

}  // namespace dovetail::steady
