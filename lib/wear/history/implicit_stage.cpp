#include "wear/history/implicit_stage.hpp"

#include <algorithm>
#include <utility>

#include "numerics/newton.hpp"
#include "steady/near_jacobian.hpp"
#include "steady/params.hpp"
#include "wear/params.hpp"

namespace dovetail::wear {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

ImplicitStage::ImplicitStage(const steady::Joint& joint, const steady::State& from, double tolerance)
    : problem_(joint, from.tangent->problem().shared_system(), from.penalty_ratio),
      tolerance_(std::max(tolerance, joint.options.tolerance)),
      factors_(from.tangent, &from.tangent->factors()),
      factored_(from.tangent, &from.tangent->point()),
      factored_at_{.displacement = from.displacement,
                   .depth = from.tangent->problem().condition().wear_depth,
                   .cycles = VectorXd::Zero(problem_.model().nodes())},
      last_(factored_) {
  if (factored_at_.depth.size() == 0) factored_at_.depth = factored_at_.cycles;
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

bool ImplicitStage::is_held(const steady::Point& point) {
  const auto nodes = static_cast<std::size_t>(problem_.model().nodes());
  std::vector<bool> bearing(nodes);
  for (std::size_t i = 0; i < nodes; ++i) bearing[i] = !point.nodes[i].always_separated;
  bool more = held_by_.size() == nodes;
  for (std::size_t i = 0; more && i < nodes; ++i) more = bearing[i] || !held_by_[i];
  if (!more && !steady::is_held(point)) return false;
  if (!more) held_by_ = std::move(bearing);
  return true;
}

void ImplicitStage::begin_step() {
  spent_on_products_ = 0;
  last_ = factored_;
}

void ImplicitStage::factorise_at(const StageFactorsAt& at) {
  auto point = std::make_shared<steady::Point>();
  steady::evaluate(problem(at.depth), at.displacement, *point);
  steady::differentiate(*point);
  auto factors =
      std::make_shared<const steady::FactoredJacobian>(CoupledPoint(*point, at.cycles).eliminated(), factors_.get());
  if (factors->status() != Status::converged) return;
  factors_ = std::move(factors);
  factored_ = last_ = std::move(point);
  factored_at_ = at;
}

std::optional<VectorXd> ImplicitStage::solved_nearly(const CoupledPoint& at, const VectorXd& rhs,
                                                     double tolerance) const {
  constexpr steady::WorkParams kParams;
  if (factors_->regularised()) return {};
  const double product = factors_->product_operations();
  const double most = (kParams.products * factors_->operations() - spent_on_products_) / product;
  if (most < 1) return {};
  numerics::GmresResult found =
      steady::solve_near(*at.eliminated(), *factors_, rhs,
                         {.tolerance = tolerance, .most = static_cast<int>(std::min(most, kParams.most_products))});
  spent_on_products_ += found.products * product;
  if (problem_.budget()) problem_.budget()->spend_on_factors(found.products * product);
  if (found.status != Status::converged) return {};
  return std::move(found.x);
}

VectorXd ImplicitStage::damp(const VectorXd& cycles, const VectorXd& error) const {
  const CoupledPoint at(*last_, cycles);
  const MatrixXd none = MatrixXd::Zero(problem_.model().contact_size(), problem_.basis().coefficients());
  const VectorXd rhs = at.right_hand_side(none, -error);
  const std::optional<VectorXd> moved = solved_nearly(at, rhs, ImplicitParams{}.damping);
  const VectorXd damped = at.deeper(moved ? *moved : VectorXd(factors_->solve(rhs)), -error);
  return damped.allFinite() ? damped : error;
}

/// The equations of a stage for Newton's method, in unknowns (U, W) that are forces relative to the excitation.
class ImplicitStage::Equations {
 public:
  Equations(ImplicitStage& stage, const VectorXd& base, const VectorXd& cycles, Index rows)
      : stage_(stage),
        base_(base),
        cycles_(cycles),
        rows_(rows),
        unknowns_(stage.problem_.unknowns()),
        force_(stage.problem_.system().force_scale),
        unit_(unknowns_ + base.size()),
        near_(*stage.last_, cycles) {
    unit_ << stage.problem_.unit_displacement(), force_ * stage.problem_.penalty().normal.cwiseInverse();
  }

  /// One step from a solution of other stages, or of none: both residuals are known there.
  [[nodiscard]] VectorXd start(const WearPoint& point) {
    residual_f_ = MatrixXd::Zero(rows_, unknowns_ / rows_);
    residual_g_ = point.depth - base_ - cycles_.cwiseProduct(point.rate);
    VectorXd step;
    direction(step);
    VectorXd x(unit_.size());
    x << point.displacement.reshaped(), point.depth;
    return x.cwiseQuotient(unit_) + step;
  }

  VectorXd residual(const VectorXd& x) {
    const VectorXd u = x.cwiseProduct(unit_);
    const Index nodes = base_.size();
    depth_ = u.tail(nodes).cwiseMax(base_);
    if (at_.use_count() > 1) at_ = std::make_shared<steady::Point>();
    steady::evaluate(stage_.problem(depth_), shaped(u.head(unknowns_)), *at_);
    rates_ = stage_.rate(*at_);
    residual_f_ = at_->residual;
    residual_g_ = u.tail(nodes) - base_ - cycles_.cwiseProduct(rates_);
    residual_.resize(unit_.size());
    residual_ << residual_f_.reshaped() / force_, residual_g_.cwiseQuotient(unit_.tail(nodes));
    return residual_;
  }

  Status newton_step(VectorXd& step) {
    if (spent(stage_.problem_.budget())) return Status::budget_spent;
    steady::differentiate(*at_);
    stage_.last_ = at_;
    near_ = CoupledPoint(*at_, cycles_);
    const VectorXd rhs = near_.right_hand_side(residual_f_, residual_g_);
    if (const std::optional<VectorXd> moved = stage_.solved_nearly(near_, rhs, forcing())) {
      step = with_depths(*moved);
      return Status::converged;
    }
    auto factors = std::make_shared<const steady::FactoredJacobian>(near_.eliminated(), stage_.factors_.get());
    if (factors->status() != Status::converged) return factors->status();
    ++stage_.jacobians_;
    stage_.factors_ = std::move(factors);
    stage_.factored_ = at_;
    stage_.factored_at_ = {.displacement = at_->displacement, .depth = depth_, .cycles = cycles_};
    stage_.spent_on_products_ = 0;
    direction(step);
    return Status::converged;
  }

  bool chord_step(VectorXd& step) {
    if (stage_.factors_->regularised()) return false;
    direction(step);
    return true;
  }

  [[nodiscard]] const steady::Point& at() const { return *at_; }
  [[nodiscard]] WearPoint point() const { return {.displacement = at_->displacement, .depth = depth_, .rate = rates_}; }

 private:
  [[nodiscard]] MatrixXd shaped(const VectorXd& u) const { return u.reshaped(rows_, u.size() / rows_); }

  /// As exact as the next step can make use of, see steady::solve.
  [[nodiscard]] double forcing() const {
    constexpr steady::WorkParams kParams;
    const double residual = residual_.norm();
    return std::min(kParams.loosest_step, std::max(residual, kParams.of_goal * stage_.tolerance_ / residual));
  }

  [[nodiscard]] VectorXd with_depths(const VectorXd& moved) const {
    VectorXd step(unit_.size());
    step << moved, near_.deeper(moved, residual_g_);
    return step.cwiseQuotient(unit_);
  }

  /// With the factors in use.
  void direction(VectorXd& step) const {
    step = with_depths(stage_.factors_->solve(near_.right_hand_side(residual_f_, residual_g_)));
  }

  ImplicitStage& stage_;
  const VectorXd &base_, &cycles_;
  Index rows_, unknowns_;
  double force_;
  VectorXd unit_;      // m per unit unknown
  CoupledPoint near_;  // of the last point with its derivative
  std::shared_ptr<steady::Point> at_ = std::make_shared<steady::Point>();
  VectorXd depth_;       // W, never below the base
  MatrixXd residual_f_;  // N
  VectorXd residual_g_;  // W - B - c r, m
  VectorXd residual_, rates_;
};

Status ImplicitStage::solve(const VectorXd& base, const VectorXd& cycles, int max_iterations, WearPoint& point) {
  ++solves_;
  Equations equations(*this, base, cycles, point.displacement.rows());
  VectorXd x = equations.start(point);
  equations.residual(x);
  constexpr ImplicitParams kParams;
  const double floor = std::min(kParams.floors * steady::rounding_floor(equations.at()), steady::FloorParams{}.largest);
  const numerics::NewtonSystem system{.residual = [&](const VectorXd& at) { return equations.residual(at); },
                                      .newton_step = [&](VectorXd& step) { return equations.newton_step(step); },
                                      .chord_step = [&](VectorXd& step) { return equations.chord_step(step); }};
  const numerics::NewtonStats stats = numerics::newton(
      system, x,
      {.tolerance = std::max(tolerance_, floor), .max_iterations = max_iterations, .chord_ratio = kParams.chord_ratio});
  if (stats.status != Status::converged) return stats.status;
  equations.residual(x);
  if (equations.at().status != Status::converged) return equations.at().status;
  if (!is_held(equations.at())) return Status::singular;
  point = equations.point();
  return Status::converged;
}

steady::State ImplicitStage::described(const WearPoint& at) const {
  steady::Point point;
  steady::evaluate(problem(at.depth), at.displacement, point);
  return steady::described(std::move(point), Status::converged, steady::AtSolution::linearise, nullptr);
}

}  // namespace dovetail::wear
