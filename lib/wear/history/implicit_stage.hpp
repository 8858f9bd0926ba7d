#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "steady/factored_jacobian.hpp"
#include "steady/state.hpp"
#include "wear/history/coupled_point.hpp"
#include "wear/history/wear_point.hpp"

namespace dovetail::wear {

/// Where the factors of a stage were taken.
struct StageFactorsAt {
  Eigen::MatrixXd displacement;  ///< U [nc, 2H+1] m
  Eigen::VectorXd depth;         ///< W [Nc] m
  Eigen::VectorXd cycles;        ///< c [Nc]; 0: those of a steady state
};

/// One implicit stage f(U; W) = 0, W = B + c r(U, W): Newton's method on (U, W) with W eliminated (coupled_point.hpp).
/// Factors are kept from stage to stage as long as chord steps with them contract, or products with the Jacobian at
/// hand cost less than new ones. Residuals are forces relative to the excitation, those of the second equation through
/// the pseudo-penalty, eps_N (W - B - c r).
class ImplicitStage {
 public:
  /// `from` is a steady state of this joint, as worn as it may be, with its tangent. Stages are solved to `tolerance`,
  /// or to that of the joint where it is more.
  ImplicitStage(const steady::Joint& joint, const steady::State& from, double tolerance);

  /// Solves from `point` and writes the solution there if it converges. `base` B [Nc] m, a lower bound of W;
  /// `cycles` c [Nc] >= 0.
  [[nodiscard]] Status solve(const Eigen::VectorXd& base, const Eigen::VectorXd& cycles, int max_iterations,
                             WearPoint& point);
  /// (I - c R)^-1 v, R = dr/dW along f = 0 near the last stage: an error as the equations damp it.
  [[nodiscard]] Eigen::VectorXd damp(const Eigen::VectorXd& cycles, const Eigen::VectorXd& error) const;
  /// The point as a steady state, with its tangent.
  [[nodiscard]] steady::State described(const WearPoint& point) const;

  /// Takes the factors there, which need not be a solution.
  void factorise_at(const StageFactorsAt& at);
  /// What was spent or seen in steps before counts no more, but for the factors: a history that is resumed does the
  /// same as one that went on.
  void begin_step();
  /// Where the factors in use were taken.
  [[nodiscard]] const StageFactorsAt& factored_at() const { return factored_at_; }

  [[nodiscard]] int solves() const { return solves_; }
  [[nodiscard]] int jacobians() const { return jacobians_; }

 private:
  class Equations;
  [[nodiscard]] std::shared_ptr<const steady::Problem> problem(const Eigen::VectorXd& depth) const;
  [[nodiscard]] Eigen::VectorXd rate(const steady::Point& point) const;
  /// See steady::is_held. What some nodes hold is held by more.
  [[nodiscard]] bool is_held(const steady::Point& point);
  /// J X = B of the eliminated point by products, with the factors in use; empty where that costs too much.
  [[nodiscard]] std::optional<Eigen::VectorXd> solved_nearly(const CoupledPoint& at, const Eigen::VectorXd& rhs,
                                                             double tolerance) const;

  steady::Problem problem_;
  double tolerance_;
  std::shared_ptr<const steady::FactoredJacobian> factors_;
  std::shared_ptr<const steady::Point> factored_;  // with its derivative
  StageFactorsAt factored_at_;
  std::shared_ptr<const steady::Point> last_;  // point with its derivative in this step, else where factors were taken
  mutable double spent_on_products_ = 0;       // in this step since they were taken, operations
  std::vector<bool> held_by_;  // nodes that are known to hold the body; an implicit history releases none
  int solves_ = 0, jacobians_ = 0;
};

}  // namespace dovetail::wear
