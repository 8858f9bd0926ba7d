#include "steady/point.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/interruption.hpp"
#include "numerics/dense_symmetric.hpp"
#include "steady/params.hpp"
#include "steady/work.hpp"

namespace dovetail::steady {

void evaluate(std::shared_ptr<const Problem> problem, const Eigen::MatrixXd& displacement, Point& point) {
  end_if_interrupted();
  point.problem = std::move(problem);
  const Problem& of = *point.problem;
  const Eigen::Index nodes = of.model().nodes(), d = of.model().directions(), k = of.basis().coefficients();
  assert(displacement.rows() == nodes * d && displacement.cols() == k);
  point.displacement = displacement;
  point.has_derivative = false;
  point.status = Status::converged;
  const Eigen::MatrixXd external = of.system().force - dynamics::apply_stiffness(of.system(), displacement);
  point.prediction = external + of.dof_penalty().asDiagonal() * displacement;
  point.prediction.col(0) -= of.dof_penalty().cwiseProduct(of.offset());
  const Eigen::MatrixXd samples = of.basis().synthesise(point.prediction);
  point.nodes.resize(static_cast<std::size_t>(nodes));
  if (!samples.allFinite()) {
    point.status = Status::not_finite;
    point.force = point.residual = Eigen::MatrixXd::Constant(nodes * d, k, std::numeric_limits<double>::quiet_NaN());
    return;
  }
  Eigen::MatrixXd force(samples.rows(), samples.cols());
  const contact::MarchOptions options = of.march_options();
  for (Eigen::Index i = 0; i < nodes; ++i) {
    contact::MarchResult& node = point.nodes[static_cast<std::size_t>(i)];
    if (of.released(i)) {
      contact::carry_nothing(samples.middleCols(i * d, d), of.penalty().tangential(i), k, node);
    } else {
      contact::march(samples.middleCols(i * d, d), of.law(i), options, node);
      if (of.budget()) of.budget()->spend(march_operations(of.basis().samples(), node.periods));
    }
    force.middleCols(i * d, d) = node.force;
    if (node.status != Status::converged) point.status = node.status;
  }
  point.force = of.basis().analyse(force);
  point.residual = point.force - external;
}

void differentiate(Point& point) {
  if (point.has_derivative || point.status == Status::not_finite) return;
  const Problem& of = *point.problem;
  const Eigen::Index d = of.model().directions(), m = d * of.basis().coefficients();
  const Eigen::MatrixXd samples = of.basis().synthesise(point.prediction);
  const contact::SlipReturn rule = of.march_options().slip_return;
  for (Eigen::Index i = 0; i < of.model().nodes(); ++i) {
    if (of.released(i)) continue;
    contact::MarchResult& node = point.nodes[static_cast<std::size_t>(i)];
    contact::differentiate(samples.middleCols(i * d, d), of.law(i), of.basis(), rule, node);
    if (of.budget()) of.budget()->spend(derivative_operations(of.basis().samples(), node.periods, m));
  }
  point.has_derivative = true;
}

JacobianBlocks blocks(const Point& point) {
  assert(point.has_derivative);
  JacobianBlocks blocks;
  blocks.stiffness = &point.problem->system().stiffness;
  for (const contact::MarchResult& node : point.nodes) blocks.derivative.push_back(&node.force_derivative);
  blocks.penalty = point.problem->dof_penalty();
  return blocks;
}

Eigen::MatrixXd jacobian(const Point& point) {
  const Eigen::Index unknowns = point.problem->unknowns();
  if (point.problem->budget()) point.problem->budget()->spend_on_factors(factorisation_operations(unknowns));
  std::vector<Eigen::Index> rows(static_cast<std::size_t>(unknowns));
  std::iota(rows.begin(), rows.end(), Eigen::Index{0});
  Eigen::MatrixXd matrix(unknowns, unknowns);
  std::vector<double*> columns;
  for (Eigen::Index j = 0; j < unknowns; ++j) columns.push_back(matrix.col(j).data());
  assemble(blocks(point), rows, columns);
  return matrix;
}

Eigen::MatrixXd apply_force_derivative(const Point& point, const Eigen::MatrixXd& change) {
  const Eigen::VectorXd applied = apply_derivative(blocks(point), change.reshaped(), false);
  return applied.reshaped(change.rows(), change.cols());
}

Eigen::MatrixXd apply_jacobian(const Point& point, const Eigen::MatrixXd& change) {
  const Eigen::MatrixXd linear = dynamics::apply_stiffness(point.problem->system(), change);
  return linear + apply_force_derivative(point, point.problem->dof_penalty().asDiagonal() * change - linear);
}

std::vector<Eigen::MatrixXd> wear_rate_by_prediction(const Point& point) {
  assert(point.has_derivative);
  const dynamics::CondensedModel& model = point.problem->model();
  std::vector<Eigen::MatrixXd> derivative;
  for (Eigen::Index i = 0; i < model.nodes(); ++i) {
    const contact::MarchResult& node = point.nodes[static_cast<std::size_t>(i)];
    const contact::WearRate by = model.wear_rate(i, {.load = node.slip_load, .energy = node.dissipation});
    derivative.emplace_back((by.by_load * node.slip_load_derivative + by.by_energy * node.dissipation_derivative)
                                .reshaped(model.directions(), point.problem->basis().coefficients()));
  }
  return derivative;
}

Eigen::MatrixXd residual_to_frequency(const Point& point) {
  // lambda_u falls by what the linear part gains, and lambda follows it through D.
  const Eigen::MatrixXd linear =
      dynamics::apply_slope(point.problem->model(), point.problem->system(), point.displacement);
  return linear - apply_force_derivative(point, linear);
}

double rounding_floor(const Point& point) {
  const double forces = point.problem->system().force.norm() + point.prediction.norm();
  return FloorParams{}.rounding * forces / point.problem->system().force_scale;
}

double attainable(const Point& point, double tolerance) {
  return std::max(tolerance, std::min(rounding_floor(point), FloorParams{}.largest));
}

namespace {

/// Whether the static stiffness with the nodes held of which `holds` says so has no negative direction.
template <class Holds>
bool is_positive(const Problem& of, const Holds& holds) {
  Eigen::MatrixXd stiffness = of.system().stiffness.mean();
  if (stiffness.size() == 0) return true;
  // Rounding may turn a direction without stiffness into a slightly negative one.
  const double shift = SingularityParams{}.held * stiffness.diagonal().cwiseAbs().maxCoeff();
  const Eigen::Index d = of.model().directions();
  for (Eigen::Index i = 0; i < of.model().nodes(); ++i)
    for (Eigen::Index r = i * d; r < (i + 1) * d; ++r) stiffness(r, r) += holds(i) ? of.dof_penalty()(r) : shift;
  return numerics::DenseCholesky(std::move(stiffness)).status() == Status::converged;
}

/// By how much the nodes open, in the mean over time, over the root of the area of all.
double opening(const Point& point) {
  const dynamics::CondensedModel& model = point.problem->model();
  double largest = 0;
  for (Eigen::Index i = 0; i < model.nodes(); ++i)
    largest = std::max(largest, -point.displacement(i * model.directions(), 0));
  return largest / std::sqrt(model.contact().area.sum());
}

}  // namespace

bool is_held(const Point& point) {
  const Problem& of = *point.problem;
  const auto carries = [&](Eigen::Index i) {
    return !of.released(i) && !point.nodes[static_cast<std::size_t>(i)].always_separated;
  };
  if (!is_positive(of, carries)) return false;
  return of.model().nodes() == 0 || opening(point) < SingularityParams{}.out_of_slot ||
         is_positive(of, [](Eigen::Index) { return false; });
}

}  // namespace dovetail::steady
