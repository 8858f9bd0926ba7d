#pragma once

#include <Eigen/Core>

namespace dovetail::contact {

/// The eps of the dynamic Lagrangian: one value for the normal direction and one for *all* tangential
/// directions of a node (different tangential values would converge to a wrong slip direction). N/m.
struct PseudoPenalty {
  Eigen::VectorXd normal;      ///< [Nc] > 0
  Eigen::VectorXd tangential;  ///< [Nc] > 0

  [[nodiscard]] PseudoPenalty scaled(double ratio) const { return {normal * ratio, tangential * ratio}; }
  /// eps of each contact dof, node by node with `directions` d each, [Nc d].
  [[nodiscard]] Eigen::VectorXd by_dof(Eigen::Index directions) const;
  [[nodiscard]] bool operator==(const PseudoPenalty& other) const {
    return normal == other.normal && tangential == other.tangential;
  }
};

/// eps from the local contact stiffness, the high-harmonic limit of diag(Z_h) when contact carries no mass:
/// `local_stiffness` [Nc d], node by node (N, T1[, T2]), d directions. The mean over tangential directions is
/// used; zero entries are replaced by a thousandth of the largest one, negative ones (contact with mass) by a
/// thousandth of their size. `normal`, `tangential` > 0 override the values of all nodes (N/m), 0 keeps the automatic
/// ones.
[[nodiscard]] PseudoPenalty pseudo_penalty(const Eigen::VectorXd& local_stiffness, Eigen::Index directions,
                                           double normal = 0, double tangential = 0);

}  // namespace dovetail::contact
