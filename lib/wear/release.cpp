#include "wear/release.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace dovetail::wear {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

double friction_margin(const response::SteadyState& state, Index node, double friction) {
  // Samples close to separation carry next to nothing: their ratio of forces is noise.
  constexpr double kLightLoad = 1e-3;
  const double largest = state.nodes[static_cast<std::size_t>(node)].max_normal_force;
  double margin = std::numeric_limits<double>::infinity();
  if (!(largest > 0.0) || friction == 0.0 || !state.linearisation) return margin;
  const MatrixXd& force = state.linearisation->state().nodes[static_cast<std::size_t>(node)].force;
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

double slip_excess(const response::CondensedModel& model, const response::SteadyState& state, Index node) {
  const response::NodeSummary& summary = state.nodes[static_cast<std::size_t>(node)];
  const double limit = model.contact().friction[node] * summary.max_normal_force;
  return limit > 0.0 ? summary.slip_distance * model.local_stiffness()[node * model.directions() + 1] / (4.0 * limit)
                     : 0.0;
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

response::SteadyState Release::solve_on(const std::shared_ptr<const response::CondensedModel>& model,
                                        const response::ContactCondition& condition,
                                        const response::SteadyOptions& options, const MatrixXd& guess) {
  response::SteadyState state;
  if (control_->stopped()) {
    state.status = Status::interrupted;
    return state;
  }
  state = response::steady_state(model, omega_, condition, options, guess, last_);
  count(1, state.iterations);
  if (state.linearisation) last_ = state.linearisation;
  return state;
}

response::SteadyState Release::solve(const std::vector<bool>& released, const MatrixXd& guess, bool quick) {
  response::ContactCondition condition = start_;
  condition.released.assign(released.begin(), released.end());
  response::SteadyOptions options = steady_;
  if (quick) {
    options.penalty_cascade = false;
    options.max_iterations = std::min(options.max_iterations, 30);
  }
  return solve_on(model_, condition, options, guess);
}

response::SteadyState Release::solve_worn(const VectorXd& depth, const MatrixXd& guess) {
  response::ContactCondition condition = start_;
  condition.wear_depth = depth;
  return solve_on(model_, condition, steady_, guess);
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
