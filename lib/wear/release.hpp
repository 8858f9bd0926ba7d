#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "steady/steady_state.hpp"
#include "wear/control.hpp"

namespace dovetail::wear {

/// Friction margin of a node over the period, min_{t,s} 1 - |lambda_T(t) - lambda_T(s)| / (mu (lambda_N(t) +
/// lambda_N(s))) over its loaded samples: what is left before no constant residual traction keeps it from slipping in
/// every cycle. (Its distance from mu lambda_N at one instant says nothing: a node that slid into place sits there.)
/// Negative for a node held beyond its friction; infinite without load or friction. `friction` is the mu to measure by.
/// O(samples^2).
[[nodiscard]] double friction_margin(const steady::State& state, Eigen::Index node, double friction);

/// Overload relieved by the slip of a node, in units of mu lambda_N: k_T (slip distance) / (4 mu max lambda_N) with the
/// node's own stiffness k_T (two reversals per cycle, each sliding by twice the overload over k_T).
[[nodiscard]] double slip_excess(const dynamics::CondensedModel& model, const steady::State& state, Eigen::Index node);

/// Steady states of one joint with some nodes released, warm-started from each other and counted.
class Release {
 public:
  Release(const steady::Joint& joint, double omega, const Control& control);

  /// State with these nodes free of contact. `quick`: one pseudo-penalty and few iterations, for states that may not
  /// exist because nothing holds the body.
  [[nodiscard]] steady::State solve(const std::vector<bool>& released, const Eigen::MatrixXd& guess,
                                    bool quick = false);
  /// State with depth W [Nc] and contact everywhere.
  [[nodiscard]] steady::State solve_worn(const Eigen::VectorXd& depth, const Eigen::MatrixXd& guess);

  /// W [Nc]: released nodes just do not touch, max(W_start, max_t u_N - g); the others keep W_start.
  [[nodiscard]] Eigen::VectorXd depth(const std::vector<bool>& released, const steady::State& state) const;

  [[nodiscard]] const dynamics::CondensedModel& model() const { return *joint_.model; }
  [[nodiscard]] const Eigen::VectorXd& start() const { return joint_.condition.wear_depth; }  ///< W before, m
  [[nodiscard]] bool stopped() const { return control_->stopped(); }
  void count(int solves, int jacobians);
  [[nodiscard]] int solves() const { return solves_; }
  [[nodiscard]] int jacobians() const { return jacobians_; }

 private:
  [[nodiscard]] steady::State solve_on(const steady::Joint& joint, const Eigen::MatrixXd& guess);

  steady::Joint joint_;
  double omega_;
  const Control* control_;
  std::shared_ptr<const steady::Tangent> last_;  // of the last state found
  int solves_ = 0;
  int jacobians_ = 0;
};

}  // namespace dovetail::wear
