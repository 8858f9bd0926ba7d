#include "branches/bordered.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/verification/steady/rod.hpp"

namespace dovetail::branches {
namespace {

// A state with open, sliding and stuck samples, away from equilibrium.
steady::Tangent linearised(double omega, double size) {
  const steady::Joint joint{.model = verification::condensed(verification::rod(3))};
  auto system = std::make_shared<const dynamics::HarmonicSystem>(
      dynamics::harmonic_system(*joint.model, joint.options.harmonics, omega));
  const auto problem = std::make_shared<const steady::Problem>(joint, system);
  Eigen::MatrixXd displacement = problem->closed_start();
  for (Eigen::Index j = 0; j < displacement.size(); ++j)
    displacement.data()[j] += size * std::sin(1.7 * static_cast<double>(j) + omega);
  auto point = std::make_shared<steady::Point>();
  steady::evaluate(problem, displacement, *point);
  steady::differentiate(*point);
  return steady::Tangent(point);
}

TEST(BorderedSystem, SolvesWithItsRowAndColumn) {
  const steady::Tangent linear = linearised(2.3, 0.1);
  const Eigen::MatrixXd jacobian = steady::jacobian(linear.point());
  const Eigen::Index n = jacobian.rows();
  const Eigen::VectorXd row = Eigen::VectorXd::LinSpaced(n, -1, 2), forces = Eigen::VectorXd::LinSpaced(n, 0.3, -0.4);
  const Eigen::VectorXd column = steady::residual_to_frequency(linear.point()).reshaped();
  const BorderedSystem bordered(linear, column, row, 0.7);
  const BorderedSystem::Solution found = bordered.solve(forces, 0.9);
  ASSERT_EQ(found.status, Status::converged);
  // Refined to 1e-10 of the terms that cancel.
  const double size = forces.norm() + column.norm() * std::abs(found.parameter);
  EXPECT_LT((jacobian * found.displacement + column * found.parameter - forces).norm(), 1e-9 * size);
  const double reach = 1 + row.norm() * found.displacement.norm();
  EXPECT_NEAR(row.dot(found.displacement) + 0.7 * found.parameter, 0.9, 1e-9 * reach);
}

}  // namespace
}  // namespace dovetail::branches
