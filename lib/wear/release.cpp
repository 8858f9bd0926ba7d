#include "wear/release.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace dovetail::wear {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

double friction_margin(const steady::State& state, Index node, double friction) {
  // Samples close to separation carry next to nothing: their ratio of forces is noise.
  constexpr double kLightLoad = 1e-3;
  const double largest = state.nodes[static_cast<std::size_t>(node)].max_normal_force;
  double margin = std::numeric_limits<double>::infinity();
  if (!(largest > 0.0) || friction == 0.0 || !state.tangent) return margin;
  const MatrixXd& force = state.tangent->point().nodes[static_cast<std::size_t>(node)].force;
  const Index tangential = force.cols() - 1;
  for (Index n = 0; n < force.rows(); ++n) {
    if (force(n, 0) <= kLightLoad * largest) continue;
    for (Index m = 0; m <= n; ++m)
      if (force(m, 0) > kLightLoad * largest)
        margin = std::min(margin, 1.0 - (force.row(n) - force.row(m)).tail(tangential).norm() /
                                            (friction * (force(n, 0) + force(m, 0))));
  }
  return margin;
}

double slip_excess(const dynamics::CondensedModel& model, const steady::State& state, Index node) {
  const steady::NodeSummary& summary = state.nodes[static_cast<std::size_t>(node)];
  const double limit = model.contact().friction[node] * summary.max_normal_force;
  return limit > 0.0 ? summary.slip_distance * model.local_stiffness()[node * model.directions() + 1] / (4.0 * limit)
                     : 0.0;
}

Release::Release(const steady::Joint& joint, double omega, const Control& control)
    : joint_(joint), omega_(omega), control_(&control) {
  if (start().size() == 0) joint_.condition.wear_depth = VectorXd::Zero(model().nodes());
}

void Release::count(int solves, int jacobians) {
  solves_ += solves;
  jacobians_ += jacobians;
}

steady::State Release::solve_on(const steady::Joint& joint, const MatrixXd& guess) {
  steady::State state;
  if (control_->stopped()) {
    state.status = Status::interrupted;
    return state;
  }
  state = steady::steady_state(joint, omega_, guess, last_);
  count(1, state.iterations);
  if (state.tangent) last_ = state.tangent;
  return state;
}

steady::State Release::solve(const std::vector<bool>& released, const MatrixXd& guess, bool quick) {
  steady::Joint joint = joint_;
  joint.condition.released.assign(released.begin(), released.end());
  if (quick) {
    joint.options.penalty_cascade = false;
    joint.options.max_iterations = std::min(joint.options.max_iterations, 30);
  }
  return solve_on(joint, guess);
}

steady::State Release::solve_worn(const VectorXd& depth, const MatrixXd& guess) {
  return solve_on(joint_.worn(depth), guess);
}

VectorXd Release::depth(const std::vector<bool>& released, const steady::State& state) const {
  VectorXd depth = start();
  for (Index i = 0; i < depth.size(); ++i)
    if (released[static_cast<std::size_t>(i)])
      depth[i] = std::max(depth[i],
                          state.nodes[static_cast<std::size_t>(i)].max_normal_displacement - model().contact().gap[i]);
  return depth;
}

}  // namespace dovetail::wear
