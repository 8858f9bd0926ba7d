#include "branches/arc.hpp"

#include <algorithm>
#include <cmath>

#include "branches/params.hpp"

namespace dovetail::branches {
namespace {

Eigen::VectorXd penalty_of(const steady::Summary& state) {
  const Eigen::Index nodes = std::max<Eigen::Index>(state.penalty.normal.size(), 1);
  return state.penalty.by_dof(state.displacement.rows() / nodes);
}

}  // namespace

double ArcMetric::inner(const Vector& a, const Vector& b) const {
  const Eigen::VectorXd squares = displacement_weight.cwiseAbs2();
  return (squares.asDiagonal() * a.displacement).cwiseProduct(b.displacement).sum() +
         parameter_weight * parameter_weight * a.parameter * b.parameter;
}

double ArcMetric::length(const Vector& a) const {
  return std::sqrt(inner(a, a));
}

Vector ArcMetric::forwards(const Eigen::MatrixXd& like, double sign) const {
  return {.displacement = Eigen::MatrixXd::Zero(like.rows(), like.cols()), .parameter = sign / parameter_weight};
}

ArcMetric::Row ArcMetric::row(const Vector& a) const {
  const Eigen::MatrixXd weighted = displacement_weight.cwiseAbs2().asDiagonal() * a.displacement;
  return {.displacement = weighted.reshaped(), .parameter = parameter_weight * parameter_weight * a.parameter};
}

Eigen::MatrixXd penalty_forces(const steady::Summary& state) {
  return penalty_of(state).asDiagonal() * state.displacement;
}

double vibrating_force(const steady::Summary& state) {
  return std::max(vibration(penalty_forces(state)), MetricParams{}.slip * vibration(state.force));
}

ArcMetric arc_metric(const steady::Summary& state, double force, double range) {
  return {.displacement_weight = penalty_of(state) / (force > 0 ? force : 1.0), .parameter_weight = 1 / range};
}

}  // namespace dovetail::branches
