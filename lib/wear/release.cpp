#include "wear/release.hpp"

#include "response/amplitude.hpp"

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

double Release::compliance(const VectorXd& share, Index node, Index direction) const {
  if (share[node] <= 0 || share[node] >= 1) return 0;
  return share[node] / (1 - share[node]) / model_->local_stiffness()[node * model_->directions() + direction];
}

response::SteadyState Release::solve_shared(const VectorXd& share, const MatrixXd& guess) {
  const Index nodes = model_->nodes(), d = model_->directions();
  response::ContactCondition condition = start_;
  condition.released.assign(static_cast<std::size_t>(nodes), 0);
  // Behind a spring the contact dof is a new one; its place in the model is taken by the structure's.
  reduction::ReducedModel model = model_->reduced();
  std::vector<Index> sprung;
  for (Index i = 0; i < nodes; ++i) {
    condition.released[static_cast<std::size_t>(i)] = share[i] >= 1;
    for (Index r = 0; r < d; ++r)
      if (compliance(share, i, r) > 0) sprung.push_back(i * d + r);
  }
  const Index n = model.size(), added = std::ssize(sprung);
  const auto grow = [&](MatrixXd& matrix) { matrix.conservativeResizeLike(MatrixXd::Zero(n + added, n + added)); };
  grow(model.mass);
  grow(model.damping);
  grow(model.stiffness);
  model.static_force.conservativeResizeLike(VectorXd::Zero(n + added));
  for (MatrixXd* rows : {&model.cosine_force, &model.sine_force, &model.output_vectors})
    rows->conservativeResizeLike(MatrixXd::Zero(rows->rows(), n + added));
  for (Index q = 0; q < added; ++q) {
    const Index dof = sprung[static_cast<std::size_t>(q)], node = dof / d, r = dof % d;
    const double spring = 1 / compliance(share, node, r);
    model.stiffness(dof, dof) += spring;
    model.stiffness(n + q, n + q) += spring;
    model.stiffness(dof, n + q) = model.stiffness(n + q, dof) = -spring;
    if (r == 0)
      model.contact.normal[node] = static_cast<int>(n + q);
    else
      model.contact.tangential(node, r - 1) = static_cast<int>(n + q);
  }
  const auto shared = std::make_shared<const response::CondensedModel>(model);
  return solve_on(shared, condition, steady_, guess);
}

VectorXd Release::shared_depth(const VectorXd& share, const response::SteadyState& state) const {
  VectorXd depth = start_.wear_depth;
  const Index d = model_->directions();
  for (Index i = 0; i < depth.size(); ++i) {
    if (share[i] <= 0) continue;
    const VectorXd closing =
        (state.displacement.row(i * d) + compliance(share, i, 0) * state.force.row(i * d)).transpose();
    depth[i] = std::max(depth[i], response::extremes(closing).maximum - model_->contact().gap[i]);
  }
  return depth;
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
