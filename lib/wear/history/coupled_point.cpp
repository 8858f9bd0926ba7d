#include "wear/history/coupled_point.hpp"

#include <cmath>
#include <utility>

#include "wear/params.hpp"

namespace dovetail::wear {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

CoupledPoint::CoupledPoint(const steady::Point& point, const VectorXd& cycles)
    : cycles_(cycles), pivot_(cycles.size()), slope_(steady::wear_rate_by_prediction(point)) {
  constexpr ImplicitParams kParams;
  auto eliminated = std::make_shared<steady::Point>(point);
  const VectorXd& penalty = point.problem->penalty().normal;
  for (Index i = 0; i < cycles.size(); ++i) {
    const MatrixXd& slope = slope_[static_cast<std::size_t>(i)];
    const double by_wear = cycles(i) * penalty(i);
    pivot_(i) = 1 + by_wear * slope(0, 0);
    // Where more load wears less a node's own part may vanish although the whole is regular.
    if (std::abs(pivot_(i)) < kParams.least_pivot) pivot_(i) = std::copysign(kParams.least_pivot, pivot_(i));
    if (by_wear == 0 || slope.isZero(0)) continue;
    MatrixXd& derivative = eliminated->nodes[static_cast<std::size_t>(i)].force_derivative;
    const VectorXd column = derivative.col(0) * (by_wear / pivot_(i));
    derivative.noalias() -= column * slope.reshaped().transpose();
  }
  eliminated_ = std::move(eliminated);
}

VectorXd CoupledPoint::right_hand_side(const MatrixXd& f, const VectorXd& g) const {
  const Index d = eliminated_->problem->model().directions();
  const VectorXd& penalty = eliminated_->problem->penalty().normal;
  MatrixXd pushed = MatrixXd::Zero(f.rows(), f.cols());
  for (Index i = 0; i < g.size(); ++i) pushed(i * d, 0) = penalty(i) * g(i);
  return -(f + steady::apply_force_derivative(*eliminated_, pushed)).reshaped();
}

VectorXd CoupledPoint::deeper(const VectorXd& du, const VectorXd& g) const {
  const steady::Problem& of = *eliminated_->problem;
  const Index d = of.model().directions(), k = of.basis().coefficients();
  const MatrixXd u = du.reshaped(du.size() / k, k);
  const MatrixXd predicted = of.dof_penalty().asDiagonal() * u - dynamics::apply_stiffness(of.system(), u);
  VectorXd deeper(g.size());
  for (Index i = 0; i < g.size(); ++i) {
    const MatrixXd& slope = slope_[static_cast<std::size_t>(i)];
    // A node that predicts more by eps_N g wears c rho_0 eps_N g more: -g + c rho_0 eps_N g / m = -g / m.
    deeper(i) = (cycles_(i) * slope.cwiseProduct(predicted.middleRows(i * d, d)).sum() - g(i)) / pivot_(i);
  }
  return deeper;
}

}  // namespace dovetail::wear
