#include "wear/implicit_stage.hpp"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "numerics/dense_lu.hpp"
#include "numerics/newton.hpp"

namespace dovetail::wear {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

ImplicitStage::ImplicitStage(const steady::Joint& joint, const steady::State& from)
    : problem_(joint, from.tangent->problem().shared_system(), from.penalty_ratio) {
  adopt(from.tangent);
}

std::shared_ptr<const steady::Problem> ImplicitStage::problem(const VectorXd& depth) const {
  return std::make_shared<const steady::Problem>(problem_.worn(depth));
}

VectorXd ImplicitStage::rate(const steady::Point& point) const {
  VectorXd rate(problem_.model().nodes());
  for (Index i = 0; i < rate.size(); ++i) {
    const contact::MarchResult& march = point.nodes[static_cast<std::size_t>(i)];
    rate[i] = problem_.model().wear_rate(i, {.load = march.slip_load, .energy = march.dissipation}).depth;
  }
  return rate;
}

void ImplicitStage::adopt(const std::shared_ptr<const steady::Tangent>& tangent) {
  tangent_ = tangent;
  const Index nodes = problem_.model().nodes();
  std::vector<Index> all(static_cast<std::size_t>(nodes));
  std::iota(all.begin(), all.end(), Index{0});
  response_ = tangent->solve(-tangent->residual_to_wear(all));
  slope_.resize(nodes, nodes);
  for (Index i = 0; i < nodes; ++i) {
    const MatrixXd change = response_.col(i).reshaped(problem_.model().contact_size(), problem_.basis().coefficients());
    slope_.col(i) = tangent->wear_rate_change(change, VectorXd::Unit(nodes, i));
  }
}

void ImplicitStage::factorise_at(const WearPoint& at) {
  auto point = std::make_shared<steady::Point>();
  steady::evaluate(problem(at.depth), at.displacement, *point);
  steady::differentiate(*point);
  auto tangent = std::make_shared<const steady::Tangent>(std::move(point), tangent_.get());
  if (tangent->status() != Status::converged) return;
  adopt(tangent);
  factored_at_ = at;
}

VectorXd ImplicitStage::damp(const VectorXd& cycles, const VectorXd& error) const {
  const numerics::DenseLu lu(MatrixXd::Identity(error.size(), error.size()) - cycles.asDiagonal() * slope_);
  if (lu.status() != Status::converged) return error;
  const VectorXd damped = lu.solve(error);
  return damped.allFinite() ? damped : error;
}

Status ImplicitStage::solve(const VectorXd& base, const VectorXd& cycles, int max_iterations, WearPoint& point) {
  const Index nodes = problem_.model().nodes();
  const Index unknowns = problem_.unknowns();
  const double force = problem_.system().force_scale;
  VectorXd unit(unknowns + nodes);  // m per unit unknown
  unit << problem_.unit_displacement(), force * problem_.penalty().normal.cwiseInverse();

  ++solves_;
  auto at = std::make_shared<steady::Point>();
  VectorXd depth;   // W, never below the base
  VectorXd excess;  // g = x - B - c r
  VectorXd rates;
  const auto shaped = [&](const VectorXd& u) -> MatrixXd {
    return u.reshaped(point.displacement.rows(), point.displacement.cols());
  };
  const auto residual = [&](const VectorXd& x) {
    const VectorXd u = x.cwiseProduct(unit);
    depth = u.tail(nodes).cwiseMax(base);
    if (at.use_count() > 1) at = std::make_shared<steady::Point>();
    steady::evaluate(problem(depth), shaped(u.head(unknowns)), *at);
    rates = rate(*at);
    excess = u.tail(nodes) - base - cycles.cwiseProduct(rates);
    VectorXd all(unknowns + nodes);
    all << at->residual.reshaped() / force, excess.cwiseQuotient(unit.tail(nodes));
    return all;
  };
  numerics::DenseLu rates_lu;
  const steady::Tangent* factored = nullptr;
  const auto direction = [&](VectorXd& step) {
    const VectorXd free = tangent_->solve(-at->residual.reshaped());
    const VectorXd driven = tangent_->wear_rate_change(shaped(free), VectorXd::Zero(nodes));
    if (factored != tangent_.get()) {
      rates_lu.factorise(MatrixXd::Identity(nodes, nodes) - cycles.asDiagonal() * slope_);
      factored = tangent_.get();
    }
    if (rates_lu.status() != Status::converged) return rates_lu.status();
    const VectorXd deeper = rates_lu.solve(cycles.cwiseProduct(driven) - excess);
    step.resize(unknowns + nodes);
    step << free + response_ * deeper, deeper;
    step = step.cwiseQuotient(unit).eval();
    return Status::converged;
  };
  const auto newton_step = [&](VectorXd& step) {
    if (spent(problem_.budget())) return Status::budget_spent;
    steady::differentiate(*at);
    auto tangent = std::make_shared<const steady::Tangent>(at, tangent_.get());
    if (tangent->status() != Status::converged) return tangent->status();
    ++jacobians_;
    adopt(tangent);
    factored_at_ = {.displacement = at->displacement, .depth = depth, .rate = {}};
    return direction(step);
  };
  const auto chord_step = [&](VectorXd& step) {
    if (tangent_->regularised()) return false;
    return direction(step) == Status::converged;
  };
  // Depth that the base adds moves the joint with it.
  const VectorXd moved = point.depth.cwiseMax(base);
  VectorXd x(unknowns + nodes);
  x << point.displacement.reshaped() + response_ * (moved - point.depth), moved;
  x = x.cwiseQuotient(unit).eval();
  residual(x);
  constexpr double kStages = 4.0;  // the second equation has a floor of its own
  const double goal =
      std::max(problem_.options().tolerance, std::min(kStages * steady::rounding_floor(*at), steady::kLargestFloor));
  const numerics::NewtonStats stats =
      numerics::newton({.residual = residual, .newton_step = newton_step, .chord_step = chord_step}, x,
                       {.tolerance = goal, .max_iterations = max_iterations, .chord_ratio = 0.4});
  if (stats.status != Status::converged) return stats.status;
  residual(x);
  if (at->status != Status::converged) return at->status;
  if (!steady::is_held(*at)) return Status::singular;
  point = {.displacement = at->displacement, .depth = depth, .rate = rates};
  return Status::converged;
}

steady::State ImplicitStage::described(const WearPoint& at) const {
  steady::Point point;
  steady::evaluate(problem(at.depth), at.displacement, point);
  return steady::described(std::move(point), Status::converged, steady::AtSolution::linearise, tangent_.get());
}

}  // namespace dovetail::wear
