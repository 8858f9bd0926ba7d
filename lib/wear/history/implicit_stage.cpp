#include "wear/history/implicit_stage.hpp"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "numerics/dense_lu.hpp"
#include "numerics/dense_product.hpp"
#include "numerics/newton.hpp"
#include "steady/params.hpp"
#include "wear/params.hpp"

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
  steady::WearRateSlopes slopes = tangent->wear_rate_slopes();
  by_displacement_ = std::move(slopes.by_displacement);
  slope_ = numerics::transposed_product(by_displacement_, response_);
  slope_.diagonal() += slopes.by_wear;
}

void ImplicitStage::factorise_at(const WearPoint& at) {
  auto point = std::make_shared<steady::Point>();
  steady::evaluate(problem(at.depth), at.displacement, *point);
  steady::differentiate(*point);
  auto tangent = std::make_shared<const steady::Tangent>(std::move(point), tangent_.get());
  if (tangent->factors().status() != Status::converged) return;
  adopt(tangent);
  factored_at_ = at;
}

VectorXd ImplicitStage::damp(const VectorXd& cycles, const VectorXd& error) const {
  const numerics::DenseLu lu(MatrixXd::Identity(error.size(), error.size()) - cycles.asDiagonal() * slope_);
  if (lu.status() != Status::converged) return error;
  const VectorXd damped = lu.solve(error);
  return damped.allFinite() ? damped : error;
}

/// The equations of a stage for Newton's method, in unknowns (U, x) that are forces relative to the excitation.
class ImplicitStage::Equations {
 public:
  Equations(ImplicitStage& stage, const VectorXd& base, const VectorXd& cycles, Index rows)
      : stage_(stage),
        base_(base),
        cycles_(cycles),
        rows_(rows),
        unknowns_(stage.problem_.unknowns()),
        force_(stage.problem_.system().force_scale),
        unit_(unknowns_ + base.size()) {
    unit_ << stage.problem_.unit_displacement(), force_ * stage.problem_.penalty().normal.cwiseInverse();
  }

  /// Depth that the base adds moves the joint with it.
  [[nodiscard]] VectorXd start(const WearPoint& point) const {
    const VectorXd moved = point.depth.cwiseMax(base_);
    VectorXd x(unit_.size());
    x << point.displacement.reshaped() + stage_.response_ * (moved - point.depth), moved;
    return x.cwiseQuotient(unit_);
  }

  VectorXd residual(const VectorXd& x) {
    const VectorXd u = x.cwiseProduct(unit_);
    const Index nodes = base_.size();
    depth_ = u.tail(nodes).cwiseMax(base_);
    if (at_.use_count() > 1) at_ = std::make_shared<steady::Point>();
    steady::evaluate(stage_.problem(depth_), shaped(u.head(unknowns_)), *at_);
    rates_ = stage_.rate(*at_);
    excess_ = u.tail(nodes) - base_ - cycles_.cwiseProduct(rates_);
    VectorXd all(unit_.size());
    all << at_->residual.reshaped() / force_, excess_.cwiseQuotient(unit_.tail(nodes));
    return all;
  }

  Status newton_step(VectorXd& step) {
    if (spent(stage_.problem_.budget())) return Status::budget_spent;
    steady::differentiate(*at_);
    auto tangent = std::make_shared<const steady::Tangent>(at_, stage_.tangent_.get());
    if (tangent->factors().status() != Status::converged) return tangent->factors().status();
    ++stage_.jacobians_;
    stage_.adopt(tangent);
    stage_.factored_at_ = {.displacement = at_->displacement, .depth = depth_, .rate = {}};
    return direction(step);
  }

  bool chord_step(VectorXd& step) {
    if (stage_.tangent_->factors().regularised()) return false;
    return direction(step) == Status::converged;
  }

  [[nodiscard]] const steady::Point& at() const { return *at_; }
  [[nodiscard]] WearPoint point() const { return {.displacement = at_->displacement, .depth = depth_, .rate = rates_}; }

 private:
  [[nodiscard]] MatrixXd shaped(const VectorXd& u) const { return u.reshaped(rows_, u.size() / rows_); }

  /// With the factors in use.
  Status direction(VectorXd& step) {
    const Index nodes = base_.size();
    const VectorXd free = stage_.tangent_->solve(-at_->residual.reshaped());
    const VectorXd driven = numerics::transposed_product(stage_.by_displacement_, free);
    if (factored_ != stage_.tangent_.get()) {
      rates_lu_.factorise(MatrixXd::Identity(nodes, nodes) - cycles_.asDiagonal() * stage_.slope_);
      factored_ = stage_.tangent_.get();
    }
    if (rates_lu_.status() != Status::converged) return rates_lu_.status();
    const VectorXd deeper = rates_lu_.solve(cycles_.cwiseProduct(driven) - excess_);
    step.resize(unit_.size());
    step << free + stage_.response_ * deeper, deeper;
    step = step.cwiseQuotient(unit_).eval();
    return Status::converged;
  }

  ImplicitStage& stage_;
  const VectorXd &base_, &cycles_;
  Index rows_, unknowns_;
  double force_;
  VectorXd unit_;  // m per unit unknown
  std::shared_ptr<steady::Point> at_ = std::make_shared<steady::Point>();
  VectorXd depth_;   // W, never below the base
  VectorXd excess_;  // g = x - B - c r
  VectorXd rates_;
  numerics::DenseLu rates_lu_;
  const steady::Tangent* factored_ = nullptr;
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
  const numerics::NewtonStats stats = numerics::newton(system, x,
                                                       {.tolerance = std::max(problem_.options().tolerance, floor),
                                                        .max_iterations = max_iterations,
                                                        .chord_ratio = kParams.chord_ratio});
  if (stats.status != Status::converged) return stats.status;
  equations.residual(x);
  if (equations.at().status != Status::converged) return equations.at().status;
  if (!steady::is_held(equations.at())) return Status::singular;
  point = equations.point();
  return Status::converged;
}

steady::State ImplicitStage::described(const WearPoint& at) const {
  steady::Point point;
  steady::evaluate(problem(at.depth), at.displacement, point);
  return steady::described(std::move(point), Status::converged, steady::AtSolution::linearise, tangent_.get());
}

}  // namespace dovetail::wear
