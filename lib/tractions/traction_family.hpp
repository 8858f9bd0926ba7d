#pragma once

#include <Eigen/Core>
#include <vector>

#include "steady/state.hpp"

namespace dovetail::tractions {

/// Residual tractions of the nodes that stay stuck as coordinates of the family of solutions: m [stuck nodes, d-1] is
/// the mean lambda_T over the limit force under the mean lambda_N, |m| <= 1 for each node under Coulomb's law. Slip
/// origins follow from m by the static stiffness seen by the stuck tangential displacements while loaded normal
/// directions stay closed and everything else keeps its mean force: exact as long as mean normal forces do not change,
/// and in any case a way to reach the whole family.
class TractionFamily {
 public:
  /// Around `nominal`, which keeps its tangent.
  explicit TractionFamily(const steady::State& nominal);

  [[nodiscard]] const std::vector<Eigen::Index>& nodes() const { return nodes_; }
  [[nodiscard]] const Eigen::MatrixXd& nominal() const { return nominal_; }          ///< m of the nominal state
  [[nodiscard]] Eigen::MatrixXd slip_origin(const Eigen::MatrixXd& traction) const;  ///< X_T [Nc, d-1]
  /// dq/dm from dq/dX_T [Nc, d-1].
  [[nodiscard]] Eigen::MatrixXd gradient(const Eigen::MatrixXd& by_slip_origin) const;
  /// The nearest m with |m| <= 1 for each node.
  [[nodiscard]] static Eigen::MatrixXd admissible(Eigen::MatrixXd traction);

 private:
  std::vector<Eigen::Index> nodes_;
  Eigen::VectorXd limit_;             // of the stuck ones, under the mean lambda_N
  Eigen::MatrixXd origin_, nominal_;  // X_T and m of the nominal state
  Eigen::MatrixXd compliance_;        // -dX_T / d lambda_T, node by node
};

/// m of all nodes [Nc, d-1]; 0 where nothing is carried or there is no friction.
[[nodiscard]] Eigen::MatrixXd mean_tractions(const steady::State& state, const dynamics::CondensedModel& model);

}  // namespace dovetail::tractions
