#include "wear/history/implicit_stage.hpp"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "numerics/dense_lu.hpp"
#include "numerics/dense_product.hpp"
#include "numerics/gmres.hpp"
#include "numerics/newton.hpp"
#include "steady/params.hpp"
#include "steady/work.hpp"
#include "wear/params.hpp"

namespace dovetail::wear {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

ImplicitStage::ImplicitStage(const steady::Joint& joint, const steady::State& from, double tolerance)
    : problem_(joint, from.tangent->problem().shared_system(), from.penalty_ratio),
      tolerance_(std::max(tolerance, joint.options.tolerance)) {
  adopt(from.tangent);
  const VectorXd& depth = from.tangent->problem().condition().wear_depth;
  factored_at_ = {.displacement = from.displacement,
                  .depth = depth.size() > 0 ? depth : VectorXd::Zero(problem_.model().nodes()),
                  .rate = {}};
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
  spent_on_products_ = 0;
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

double ImplicitStage::adoption_operations() const {
  const auto nodes = static_cast<double>(slope_.rows()), unknowns = static_cast<double>(response_.rows());
  const auto dense = static_cast<double>(tangent_->factors().size()),
             contact = static_cast<double>(problem_.model().contact_size());
  return tangent_->factors().operations() + 2 * nodes * (dense * dense + unknowns * (contact + nodes));
}

double ImplicitStage::product_operations() const {
  const auto entries = static_cast<double>(response_.size() + by_displacement_.size());
  return tangent_->factors().product_operations() + steady::product_operations(entries);
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
  Equations(ImplicitStage& stage, const VectorXd& base, const VectorXd& cycles, Index rows, double tolerance)
      : stage_(stage),
        base_(base),
        cycles_(cycles),
        rows_(rows),
        goal_(tolerance),
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
    const VectorXd excess = u.tail(nodes) - base_ - cycles_.cwiseProduct(rates_);
    residual_.resize(unit_.size());
    residual_ << at_->residual.reshaped() / force_, excess.cwiseQuotient(unit_.tail(nodes));
    return residual_;
  }

  Status newton_step(VectorXd& step) {
    if (spent(stage_.problem_.budget())) return Status::budget_spent;
    steady::differentiate(*at_);
    if (nearly(step)) return Status::converged;
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

  /// The step by products with the Jacobian at the point and the factors in use, while that costs less than new ones.
  bool nearly(VectorXd& step) {
    const steady::FactoredJacobian& factors = stage_.tangent_->factors();
    if (factors.regularised() || rates_factors().status() != Status::converged) return false;
    const double product = stage_.product_operations();
    const double most =
        (steady::WorkParams{}.products * stage_.adoption_operations() - stage_.spent_on_products_) / product;
    if (most < 1) return false;
    const std::vector<MatrixXd> by_prediction = steady::wear_rate_by_prediction(*at_);
    const numerics::GmresResult found = numerics::gmres(
        {.apply = [&](const VectorXd& x) { return applied(by_prediction, x); },
         .near_solve = [this](const VectorXd& b) { return solved(b); }},
        -residual_,
        {.tolerance = forcing(), .most = static_cast<int>(std::min(most, steady::WorkParams{}.most_products))});
    stage_.spent_on_products_ += found.products * product;
    if (stage_.problem_.budget()) stage_.problem_.budget()->spend_on_factors(found.products * product);
    if (found.status != Status::converged) return false;
    step = found.x;
    return true;
  }

  /// As exact as the next step can make use of, see steady::solve.
  [[nodiscard]] double forcing() const {
    constexpr steady::WorkParams kParams;
    const double residual = residual_.norm();
    return std::min(kParams.loosest_step, std::max(residual, kParams.of_goal * goal_ / residual));
  }

  /// The Jacobian of both equations at the point.
  [[nodiscard]] VectorXd applied(const std::vector<MatrixXd>& by_prediction, const VectorXd& x) const {
    const steady::Problem& of = stage_.problem_;
    const Index nodes = base_.size(), d = of.model().directions(), k = unknowns_ / rows_;
    const VectorXd all = x.cwiseProduct(unit_), deeper = all.tail(nodes);
    const MatrixXd u = shaped(all.head(unknowns_)), linear = dynamics::apply_stiffness(of.system(), u);
    MatrixXd predicted = of.dof_penalty().asDiagonal() * u - linear;
    for (Index i = 0; i < nodes; ++i) predicted(i * d, 0) -= of.penalty().normal(i) * deeper(i);
    const MatrixXd force = linear + steady::apply_force_derivative(*at_, predicted);
    VectorXd faster(nodes);
    for (Index i = 0; i < nodes; ++i)
      faster(i) = by_prediction[static_cast<std::size_t>(i)].cwiseProduct(predicted.block(i * d, 0, d, k)).sum();
    VectorXd result(unit_.size());
    result << force.reshaped() / force_, (deeper - cycles_.cwiseProduct(faster)).cwiseQuotient(unit_.tail(nodes));
    return result;
  }

  /// Of I - c R with the factors in use.
  const numerics::DenseLu& rates_factors() {
    if (factored_ != stage_.tangent_.get()) {
      const Index nodes = base_.size();
      rates_lu_.factorise(MatrixXd::Identity(nodes, nodes) - cycles_.asDiagonal() * stage_.slope_);
      factored_ = stage_.tangent_.get();
    }
    return rates_lu_;
  }

  /// Step for a right-hand side of both equations with the factors in use, which must be regular.
  [[nodiscard]] VectorXd solved(const VectorXd& rhs) const {
    const Index nodes = base_.size();
    const VectorXd free = stage_.tangent_->solve(force_ * rhs.head(unknowns_));
    const VectorXd driven = numerics::transposed_product(stage_.by_displacement_, free);
    const VectorXd deeper =
        rates_lu_.solve(cycles_.cwiseProduct(driven) + rhs.tail(nodes).cwiseProduct(unit_.tail(nodes)));
    VectorXd step(unit_.size());
    step << free + stage_.response_ * deeper, deeper;
    return step.cwiseQuotient(unit_);
  }

  /// With the factors in use.
  Status direction(VectorXd& step) {
    if (rates_factors().status() != Status::converged) return rates_lu_.status();
    step = solved(-residual_);
    return Status::converged;
  }

  ImplicitStage& stage_;
  const VectorXd &base_, &cycles_;
  Index rows_;
  double goal_;  // a start's floor may raise it
  Index unknowns_;
  double force_;
  VectorXd unit_;  // m per unit unknown
  std::shared_ptr<steady::Point> at_ = std::make_shared<steady::Point>();
  VectorXd depth_;     // W, never below the base
  VectorXd residual_;  // of f and of g = x - B - c r
  VectorXd rates_;
  numerics::DenseLu rates_lu_;
  const steady::Tangent* factored_ = nullptr;
};

Status ImplicitStage::solve(const VectorXd& base, const VectorXd& cycles, int max_iterations, WearPoint& point) {
  ++solves_;
  Equations equations(*this, base, cycles, point.displacement.rows(), tolerance_);
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
