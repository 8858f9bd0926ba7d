#include "wear/release.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace dovetail::wear {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd friction_score(const response::CondensedModel& model, const response::SteadyState& state, double threshold) {
  // Samples close to separation carry next to nothing: their ratio of forces is noise.
  constexpr double kLightLoad = 1e-3;
  VectorXd score = VectorXd::Constant(model.nodes(), std::numeric_limits<double>::infinity());
  for (Index i = 0; i < model.nodes(); ++i) {
    const response::NodeSummary& node = state.nodes[static_cast<std::size_t>(i)];
    const double friction = model.contact().friction[i];
    if (!node.carries_load || !(node.max_normal_force > 0.0) || friction == 0.0) continue;
    if (state.wear_rate[i] > threshold) {
      const double stiffness = model.local_stiffness()[i * model.directions() + 1];
      score[i] = -node.slip_distance * stiffness / (4.0 * friction * node.max_normal_force);
    } else if (state.linearisation) {
      const MatrixXd& force = state.linearisation->state().nodes[static_cast<std::size_t>(i)].force;
      double margin = 1.0;
      for (Index n = 0; n < force.rows(); ++n) {
        if (force(n, 0) <= kLightLoad * node.max_normal_force) continue;
        margin = std::min(margin, 1.0 - force.row(n).tail(force.cols() - 1).norm() / (friction * force(n, 0)));
      }
      score[i] = std::max(margin, 0.0);
    }
  }
  return score;
}

Release::Release(std::shared_ptr<const response::CondensedModel> model, double omega, response::ContactCondition start,
                 response::SteadyOptions steady, const Control& control)
    : model_(std::move(model)),
      omega_(omega),
      start_(std::move(start)),
      steady_(std::move(steady)),
      control_(&control) {
  if (start_.wear_depth.size() == 0) start_.wear_depth = VectorXd::Zero(model_->nodes());
}

void Release::count(int solves, int jacobians) {
  solves_ += solves;
  jacobians_ += jacobians;
}

response::SteadyState Release::solve(const std::vector<bool>& released, const MatrixXd& guess, bool quick) {
  response::ContactCondition condition = start_;
  condition.released.assign(released.begin(), released.end());
  response::SteadyOptions options = steady_;
  if (quick) {
    options.penalty_cascade = false;
    options.max_iterations = std::min(options.max_iterations, 30);
  }
  response::SteadyState state;
  if (control_->stopped()) {
    state.status = Status::interrupted;
    return state;
  }
  state = response::steady_state(model_, omega_, condition, options, guess);
  count(1, state.iterations);
  if (state.status == Status::converged || quick || guess.size() == 0 || control_->stopped()) return state;
  state = response::steady_state(model_, omega_, condition, options);
  count(1, state.iterations);
  return state;
}

response::SteadyState Release::solve_worn(const VectorXd& depth, const MatrixXd& guess) {
  response::ContactCondition condition = start_;
  condition.wear_depth = depth;
  response::SteadyState state;
  if (control_->stopped()) {
    state.status = Status::interrupted;
    return state;
  }
  state = response::steady_state(model_, omega_, condition, steady_, guess);
  count(1, state.iterations);
  return state;
}

VectorXd Release::depth(const std::vector<bool>& released, const response::SteadyState& state) const {
  VectorXd depth = start_.wear_depth;
  for (Index i = 0; i < depth.size(); ++i)
    if (released[static_cast<std::size_t>(i)])
      depth[i] = std::max(depth[i],
                          state.nodes[static_cast<std::size_t>(i)].max_normal_displacement - model_->contact().gap[i]);
  return depth;
}

}  // namespace dovetail::wear
