#pragma once

#include <Eigen/Core>
#include <memory>

#include "steady/state.hpp"
#include "wear/history/wear_point.hpp"

namespace dovetail::wear {

/// One implicit stage f(U; W) = 0, W = B + c r(U, W): Newton's method on (U, W) with U eliminated. Factors are kept
/// from stage to stage as long as chord steps with them contract. Residuals are forces relative to the excitation,
/// those of the second equation through the pseudo-penalty, eps_N (W - B - c r).
class ImplicitStage {
 public:
  /// `from` is a steady state of this joint, as worn as it may be, with its tangent. Stages are solved to `tolerance`,
  /// or to that of the joint where it is more.
  ImplicitStage(const steady::Joint& joint, const steady::State& from, double tolerance);

  /// Solves from `point` and writes the solution there if it converges. `base` B [Nc] m, a lower bound of W;
  /// `cycles` c [Nc] >= 0.
  [[nodiscard]] Status solve(const Eigen::VectorXd& base, const Eigen::VectorXd& cycles, int max_iterations,
                             WearPoint& point);
  /// (I - c R)^-1 v with the factors of the last stage: an error as the equations damp it.
  [[nodiscard]] Eigen::VectorXd damp(const Eigen::VectorXd& cycles, const Eigen::VectorXd& error) const;
  /// The point as a steady state, with its tangent.
  [[nodiscard]] steady::State described(const WearPoint& point) const;
  /// Factors of a steady state computed elsewhere.
  void adopt(const std::shared_ptr<const steady::Tangent>& tangent);

  /// Takes the factors at a point, which need not be a solution.
  void factorise_at(const WearPoint& point);
  /// Of products, what was spent in steps before counts no more: a history that is resumed does the same as one that
  /// went on.
  void begin_step() { spent_on_products_ = 0; }
  /// Where the factors in use were taken.
  [[nodiscard]] const WearPoint& factored_at() const { return factored_at_; }

  [[nodiscard]] int solves() const { return solves_; }
  [[nodiscard]] int jacobians() const { return jacobians_; }

 private:
  class Equations;
  [[nodiscard]] std::shared_ptr<const steady::Problem> problem(const Eigen::VectorXd& depth) const;
  /// Of new factors with what follows from them, and of a product with a Jacobian and solving once with them.
  [[nodiscard]] double adoption_operations() const;
  [[nodiscard]] double product_operations() const;
  [[nodiscard]] Eigen::VectorXd rate(const steady::Point& point) const;

  steady::Problem problem_;
  double tolerance_;
  std::shared_ptr<const steady::Tangent> tangent_;
  WearPoint factored_at_;            // without its rate
  Eigen::MatrixXd by_displacement_;  // dr/dU at the same W, a column per node [nc (2H+1), Nc]
  Eigen::MatrixXd response_;         // dU/dW along f = 0, [nc (2H+1), Nc]
  Eigen::MatrixXd slope_;            // R = dr/dW along f = 0, [Nc, Nc]
  double spent_on_products_ = 0;     // in this step since they were taken, operations
  int solves_ = 0, jacobians_ = 0;
};

}  // namespace dovetail::wear
