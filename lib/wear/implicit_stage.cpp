#include "wear/implicit_stage.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "numerics/newton.hpp"

namespace dovetail::wear {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

ImplicitStage::ImplicitStage(std::shared_ptr<const response::CondensedModel> model,
                             response::ContactCondition condition, response::SteadyOptions steady,
                             const response::SteadyState& from)
    : model_(std::move(model)),
      condition_(std::move(condition)),
      steady_(std::move(steady)),
      ratio_(from.penalty_ratio),
      basis_(steady_.harmonics, steady_.samples),
      system_(from.linearisation->residual().shared_system()) {
  adopt(from.linearisation);
}

response::SteadyResidual ImplicitStage::problem(const VectorXd& depth) const {
  response::ContactCondition condition = condition_;
  condition.wear_depth = depth;
  return response::steady_problem(model_, system_, basis_, condition, steady_, ratio_);
}

VectorXd ImplicitStage::rate(const response::ResidualState& state) const {
  const reduction::ContactNodes& contact = model_->contact();
  VectorXd rate(model_->nodes());
  for (Index i = 0; i < rate.size(); ++i)
    rate[i] = contact.wear_coefficient[i] / contact.area[i] * state.nodes[static_cast<std::size_t>(i)].slip_load;
  return rate;
}

void ImplicitStage::adopt(const std::shared_ptr<const response::Linearisation>& linear) {
  linear_ = linear;
  const Index nodes = model_->nodes();
  std::vector<Index> all(static_cast<std::size_t>(nodes));
  std::iota(all.begin(), all.end(), Index{0});
  response_ = linear->solve(-linear->residual_to_wear(all));
  slope_.resize(nodes, nodes);
  for (Index i = 0; i < nodes; ++i) {
    const MatrixXd change = response_.col(i).reshaped(model_->contact_size(), basis_.coefficients());
    slope_.col(i) = linear->wear_rate_change(change, VectorXd::Unit(nodes, i));
  }
}

void ImplicitStage::factorise_at(const WearPoint& point) {
  const response::SteadyResidual here = problem(point.depth);
  response::ResidualState state;
  here.evaluate(point.displacement, true, state);
  auto linear = std::make_shared<const response::Linearisation>(here, state, linear_.get());
  if (linear->status() != Status::converged) return;
  adopt(linear);
  factored_at_ = point;
}

VectorXd ImplicitStage::damp(const VectorXd& cycles, const VectorXd& error) const {
  const MatrixXd matrix = MatrixXd::Identity(error.size(), error.size()) - cycles.asDiagonal() * slope_;
  const VectorXd damped = matrix.partialPivLu().solve(error);
  return damped.allFinite() ? damped : error;
}

Status ImplicitStage::solve(const VectorXd& base, const VectorXd& cycles, int max_iterations, WearPoint& point) {
  const Index nodes = model_->nodes();
  const Index unknowns = point.displacement.size();
  const double force = system_->force_scale;
  const contact::PseudoPenalty penalty = problem(base).penalty();
  VectorXd unit(unknowns + nodes);  // m per unit unknown
  for (Index j = 0; j < unknowns; ++j) {
    const Index dof = j % model_->contact_size();
    const Index node = dof / model_->directions();
    unit[j] = force / (dof % model_->directions() == 0 ? penalty.normal(node) : penalty.tangential(node));
  }
  for (Index i = 0; i < nodes; ++i) unit[unknowns + i] = force / penalty.normal(i);

  ++solves_;
  response::ResidualState state;
  VectorXd depth;   // W, never below the base
  VectorXd excess;  // g = x - B - c r
  VectorXd rates;
  const auto residual = [&](const VectorXd& x) {
    const VectorXd at = x.cwiseProduct(unit);
    depth = at.tail(nodes).cwiseMax(base);
    problem(depth).evaluate(at.head(unknowns).reshaped(point.displacement.rows(), point.displacement.cols()), false,
                            state);
    ++evaluations_;
    rates = rate(state);
    excess = at.tail(nodes) - base - cycles.cwiseProduct(rates);
    VectorXd all(unknowns + nodes);
    all << state.residual.reshaped() / force, excess.cwiseQuotient(unit.tail(nodes));
    return all;
  };
  Eigen::PartialPivLU<MatrixXd> rates_lu;
  const response::Linearisation* factored = nullptr;
  const auto direction = [&](VectorXd& step) {
    const VectorXd free = linear_->solve(-state.residual.reshaped());
    const VectorXd driven = linear_->wear_rate_change(
        free.reshaped(point.displacement.rows(), point.displacement.cols()), VectorXd::Zero(nodes));
    if (factored != linear_.get()) {
      rates_lu.compute(MatrixXd::Identity(nodes, nodes) - cycles.asDiagonal() * slope_);
      factored = linear_.get();
    }
    const VectorXd deeper = rates_lu.solve(cycles.cwiseProduct(driven) - excess);
    step.resize(unknowns + nodes);
    step << free + response_ * deeper, deeper;
    step = step.cwiseQuotient(unit).eval();
  };
  const numerics::NewtonSystem system{.residual = residual,
                                      .newton_step =
                                          [&](VectorXd& step) {
                                            if (spent(steady_.budget)) return Status::budget_spent;
                                            const response::SteadyResidual here = problem(depth);
                                            const MatrixXd at = state.displacement;
                                            here.evaluate(at, true, state);
                                            auto linear = std::make_shared<const response::Linearisation>(
                                                here, state, linear_.get());
                                            if (linear->status() != Status::converged) return linear->status();
                                            ++jacobians_;
                                            adopt(linear);
                                            factored_at_ = {.displacement = at, .depth = depth, .rate = {}};
                                            direction(step);
                                            return Status::converged;
                                          },
                                      .chord_step =
                                          [&](VectorXd& step) {
                                            if (linear_->regularised()) return false;
                                            direction(step);
                                            return true;
                                          }};
  // Depth that the base adds moves the joint with it.
  const VectorXd moved = point.depth.cwiseMax(base);
  VectorXd x(unknowns + nodes);
  x << point.displacement.reshaped() + response_ * (moved - point.depth), moved;
  x = x.cwiseQuotient(unit).eval();
  residual(x);
  const double floor = response::rounding_floor(problem(depth), state);
  const double goal = std::max(steady_.tolerance, std::min(4.0 * floor, response::kLargestFloor));
  const numerics::NewtonStats stats =
      numerics::newton(system, x, {.tolerance = goal, .max_iterations = max_iterations, .chord_ratio = 0.4});
  if (stats.status != Status::converged) return stats.status;
  residual(x);
  if (state.status != Status::converged) return state.status;
  if (!response::is_held(problem(depth), state)) return Status::singular;
  point = {.displacement = state.displacement, .depth = depth, .rate = rates};
  return Status::converged;
}

response::SteadyState ImplicitStage::described(const WearPoint& point) const {
  response::SteadyState state = response::described(problem(point.depth), point.displacement, Status::converged,
                                                    response::AtSolution::linearise, linear_.get());
  state.penalty_ratio = ratio_;
  return state;
}

}  // namespace dovetail::wear
