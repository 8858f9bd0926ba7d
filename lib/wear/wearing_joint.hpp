#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "paths/resonance.hpp"
#include "steady/state.hpp"
#include "wear/watcher.hpp"

namespace dovetail::wear {

/// Throws InputError when a computation that finds out which nodes wear off starts with some released.
void require_nothing_released(const steady::Condition& start);

/// A joint as it wears: a depth gives a steady state, the state a rate. Whatever a wear computation solves besides
/// implicit stages it solves here, warm-started from what was solved before, and counted.
class WearingJoint {
 public:
  WearingJoint(const steady::Joint& joint, double omega, const Watcher& watcher);

  /// Excites at the resonance of the joint as worn from now on instead of holding omega.
  void follow(const paths::ResonanceOptions& resonance);

  /// State worn to W [Nc], contact everywhere.
  [[nodiscard]] steady::State worn(const Eigen::VectorXd& depth, const Eigen::MatrixXd& guess);
  /// State with these nodes free of contact. `quick`: one pseudo-penalty and few iterations, for states that may not
  /// exist because nothing holds the body.
  [[nodiscard]] steady::State released(const std::vector<bool>& nodes, const Eigen::MatrixXd& guess,
                                       bool quick = false);
  /// W [Nc]: released nodes just do not touch, max(W_start, max_t u_N - g); the others keep W_start.
  [[nodiscard]] Eigen::VectorXd depth(const std::vector<bool>& released, const steady::State& state) const;

  [[nodiscard]] const steady::Joint& joint() const { return joint_; }
  [[nodiscard]] const dynamics::CondensedModel& model() const { return *joint_.model; }
  [[nodiscard]] const Eigen::VectorXd& start() const { return joint_.condition.wear_depth; }  ///< W before, m
  [[nodiscard]] const Watcher& watcher() const { return *watcher_; }
  void count(int solves, int jacobians);
  [[nodiscard]] int solves() const { return solves_; }
  [[nodiscard]] int jacobians() const { return jacobians_; }

 private:
  [[nodiscard]] steady::State solve(const steady::Joint& joint, const Eigen::MatrixXd& guess);

  steady::Joint joint_;
  double omega_;
  std::optional<paths::ResonanceOptions> resonance_;
  const Watcher* watcher_;
  std::shared_ptr<const steady::Tangent> last_;  // of the last state found
  int solves_ = 0;
  int jacobians_ = 0;
};

}  // namespace dovetail::wear
