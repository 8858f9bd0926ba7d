#pragma once

#include <Eigen/Core>

#include "branches/arc.hpp"
#include "steady/tangent.hpp"

namespace dovetail::branches {

/// The linear system of a point (U, s) on a branch,
///   [ J      df/ds ] [ dU ]   [ a ]
///   [ r^T    c     ] [ ds ] = [ b ],
/// solved with the factors of J and iterative refinement of the whole. It is regular at a turning point, where J is
/// singular [Keller 1977; Govaerts & Pryce 1990]; when the factors of J are too poor for the refinement to work, the
/// bordered matrix is factorised densely.
class BorderedSystem {
 public:
  /// Refers to `tangent`. `column` is df/ds and `row` r, both over vec(U); r and `corner` c must not both vanish.
  BorderedSystem(const steady::Tangent& tangent, Eigen::VectorXd column, Eigen::VectorXd row, double corner);

  struct Solution {
    Status status = Status::singular;
    Eigen::VectorXd displacement;  ///< dU over vec(U), m
    double parameter = 0;          ///< ds
  };
  [[nodiscard]] Solution solve(const Eigen::VectorXd& forces, double constraint) const;
  /// A solution as a direction of the branch.
  [[nodiscard]] Vector vector(const Solution& solution) const;

 private:
  struct Defect {
    Eigen::VectorXd forces;
    double constraint = 0;
  };
  [[nodiscard]] Defect defect(const Solution& at, const Eigen::VectorXd& forces, double constraint) const;
  void eliminate(const Defect& defect, Solution& solution) const;
  [[nodiscard]] Solution solve_densely(const Eigen::VectorXd& forces, double constraint) const;

  const steady::Tangent& tangent_;
  Eigen::VectorXd column_, row_;
  double corner_;
  Eigen::VectorXd by_column_;  // J^-1 df/ds
};

}  // namespace dovetail::branches
