#include "wear/wearing_joint.hpp"

#include <algorithm>
#include <utility>

#include "core/errors.hpp"
#include "dynamics/extremes.hpp"
#include "paths/steady_state.hpp"

namespace dovetail::wear {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

void require_nothing_released(const steady::Condition& start) {
  if (std::ranges::all_of(start.released, [](char released) { return released == 0; })) return;
  throw InputError(Violation{.file = {},
                             .key = "start.released",
                             .value = "some nodes",
                             .allowed = "must release no node: which ones wear off is the answer"});
}

WearingJoint::WearingJoint(const steady::Joint& joint, double omega, const Watcher& watcher)
    : joint_(joint), omega_(omega), watcher_(&watcher) {
  if (start().size() == 0) joint_.condition.wear_depth = VectorXd::Zero(model().nodes());
}

void WearingJoint::follow(const paths::ResonanceOptions& resonance) {
  resonance_ = resonance;
  resonance_->sweep_range = 0;  // the peak is followed: one found elsewhere would not be the same
}

void WearingJoint::count(int solves, int jacobians) {
  solves_ += solves;
  jacobians_ += jacobians;
}

steady::State WearingJoint::solve(const steady::Joint& joint, const MatrixXd& guess) {
  steady::State state;
  if (watcher_->stopped()) {
    state.status = Status::interrupted;
    return state;
  }
  if (resonance_) {
    paths::Resonance found = paths::resonance(joint, omega_, *resonance_, guess);
    count(found.solves, found.jacobians);
    state = std::move(found.state);
    state.status = found.status;
    if (found.status == Status::converged) omega_ = found.omega;
  } else {
    state = paths::steady_state(joint, omega_, guess, last_);
    count(1, state.iterations);
  }
  if (state.tangent) last_ = state.tangent;
  return state;
}

steady::State WearingJoint::released(const std::vector<bool>& nodes, const MatrixXd& guess, bool quick) {
  steady::Joint joint = joint_;
  joint.condition.released.assign(nodes.begin(), nodes.end());
  if (quick) {
    joint.options.penalty_cascade = false;
    joint.options.max_iterations = std::min(joint.options.max_iterations, 30);
  }
  return solve(joint, guess);
}

steady::State WearingJoint::worn(const VectorXd& depth, const MatrixXd& guess) {
  return solve(joint_.worn(depth), guess);
}

VectorXd WearingJoint::depth(const std::vector<bool>& released, const steady::State& state) const {
  VectorXd depth = start();
  for (Index i = 0; i < depth.size(); ++i)
    if (released[static_cast<std::size_t>(i)]) {
      const VectorXd normal = state.displacement.row(i * model().directions());
      depth[i] = std::max(depth[i], dynamics::extremes(normal).maximum - model().contact().gap[i]);
    }
  return depth;
}

}  // namespace dovetail::wear
