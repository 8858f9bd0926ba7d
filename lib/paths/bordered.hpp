#pragma once

#include <Eigen/Core>

#include "paths/arc.hpp"
#include "steady/tangent.hpp"

namespace dovetail::paths {

/// The linear system of a point (U, omega) on a branch,
///   [ J      df/dw ] [ dU ]   [ a ]
///   [ r^T    c     ] [ dw ] = [ b ],
/// solved with the factors of J and iterative refinement of the whole. It is regular at a turning point, where J is
/// singular [Keller 1977; Govaerts & Pryce 1990]; when the factors of J are too poor for the refinement to work, the
/// bordered matrix is factorised densely.
class BorderedSystem {
 public:
  /// Refers to `tangent`. `row` r (over vec(U)) and `corner` c must not both vanish.
  BorderedSystem(const steady::Tangent& tangent, Eigen::VectorXd row, double corner);

  struct Solution {
    Status status = Status::singular;
    Eigen::VectorXd displacement;  ///< dU over vec(U), m
    double omega = 0;              ///< dw, rad/s
  };
  [[nodiscard]] Solution solve(const Eigen::VectorXd& forces, double constraint) const;
  /// A solution as a direction of the branch.
  [[nodiscard]] BranchVector vector(const Solution& solution) const;

 private:
  struct Defect {
    Eigen::VectorXd forces;
    double constraint = 0;
  };
  [[nodiscard]] Defect defect(const Solution& at, const Eigen::VectorXd& forces, double constraint) const;
  void eliminate(const Defect& defect, Solution& solution) const;
  [[nodiscard]] Solution solve_densely(const Eigen::VectorXd& forces, double constraint) const;

  const steady::Tangent& tangent_;
  Eigen::VectorXd row_, column_;
  double corner_;
  Eigen::VectorXd by_column_;  // J^-1 df/dw
};

}  // namespace dovetail::paths
