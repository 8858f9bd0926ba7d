#pragma once

#include <Eigen/Core>
#include <memory>
#include <random>

#include "steady/point.hpp"

namespace dovetail {

/// Proportional, so that coordinates within are modal; not; or of those alone, so that harmonics share what is static.
enum class Damping { proportional, general, within };

/// A random structure held everywhere, with `nodes` contact nodes under pressure and strong excitation.
inline reduction::ReducedModel random_model(Eigen::Index nodes, Eigen::Index tangential, Damping damping) {
  const Eigen::Index nc = nodes * (1 + tangential), ni = 6, n = nc + ni;
  std::mt19937 generator(3);
  std::normal_distribution<double> normal;
  const auto draw = [&] { return normal(generator); };
  const Eigen::MatrixXd a = Eigen::MatrixXd::NullaryExpr(n, n, draw);
  reduction::ReducedModel model;
  model.stiffness = a * a.transpose() / static_cast<double>(n) + 3 * Eigen::MatrixXd::Identity(n, n);
  model.mass = Eigen::MatrixXd::Zero(n, n);
  const Eigen::MatrixXd b = Eigen::MatrixXd::NullaryExpr(ni, ni, draw);
  model.mass.topLeftCorner(ni, ni) = b * b.transpose() + Eigen::MatrixXd::Identity(ni, ni);
  model.damping = 0.02 * model.mass;
  if (damping != Damping::within) model.damping += 0.03 * model.stiffness;
  if (damping == Damping::general) model.damping(0, 0) += 0.7;
  model.static_force = Eigen::VectorXd::Zero(n);
  model.cosine_force = Eigen::MatrixXd::NullaryExpr(2, n, draw);
  model.sine_force = Eigen::MatrixXd::Zero(2, n);
  model.sine_force.row(0) = Eigen::RowVectorXd::NullaryExpr(n, draw);
  model.contact.normal.resize(nodes);
  model.contact.tangential.resize(nodes, tangential);
  for (Eigen::Index i = 0; i < nodes; ++i) {
    model.contact.normal(i) = static_cast<int>(ni + i * (1 + tangential));
    model.static_force(model.contact.normal(i)) = 2;
    for (Eigen::Index r = 0; r < tangential; ++r)
      model.contact.tangential(i, r) = model.contact.normal(i) + 1 + static_cast<int>(r);
  }
  model.contact.area = Eigen::VectorXd::Constant(nodes, 0.5);
  model.contact.gap = Eigen::VectorXd::NullaryExpr(nodes, [&] { return 0.1 * normal(generator); });
  model.contact.friction = Eigen::VectorXd::Constant(nodes, 0.3);
  model.contact.wear_coefficient = Eigen::VectorXd::Constant(nodes, 1e-3);
  model.output_vectors = Eigen::MatrixXd::Identity(2, n);
  model.output_names = {"a", "b"};
  return model;
}

inline std::shared_ptr<const steady::Problem> problem(
    const std::shared_ptr<const dynamics::CondensedModel>& model, double omega, const steady::Condition& condition,
    contact::SlipReturn slip_return = contact::SlipReturn::first_order) {
  const steady::Options options{.harmonics = 3, .samples = 64, .slip_return = slip_return, .periodic_tolerance = 1e-13};
  auto system = std::make_shared<const dynamics::HarmonicSystem>(dynamics::harmonic_system(*model, 3, omega));
  return std::make_shared<const steady::Problem>(steady::Joint{model, condition, options}, std::move(system));
}

/// A point with its derivative.
inline std::shared_ptr<const steady::Point> point(const std::shared_ptr<const steady::Problem>& problem,
                                                  const Eigen::MatrixXd& displacement) {
  auto result = std::make_shared<steady::Point>();
  steady::evaluate(problem, displacement, *result);
  steady::differentiate(*result);
  return result;
}

}  // namespace dovetail
