#include "numerics/path.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace dovetail::numerics {
namespace {

// s = zigzag(x): up to 1/2 at x = 1/2, back to 0 at x = 1, then up through 1 at x = 2. The way turns back at both
// kinks.
TEST(Path, TurnsBackAtKinks) {
  double at = 0;
  const auto slope = [](double x) { return x < 0.5 ? 1.0 : x < 1 ? -1.0 : 1.0; };
  const auto zigzag = [](double x) { return x < 0.5 ? x : x < 1 ? 1 - x : x - 1; };
  double arrived = 0;
  const PathSystem system{.residual =
                              [&](const Eigen::VectorXd& y) {
                                at = y(0);
                                return Eigen::VectorXd::Constant(1, zigzag(y(0)) - y(1));
                              },
                          .jacobian = [&] { return Eigen::MatrixXd(Eigen::RowVector2d(slope(at), -1)); },
                          .arrive =
                              [&](const Eigen::VectorXd& x) {
                                arrived = x(0);
                                return true;
                              }};
  const PathStats stats = follow_path(system, Eigen::Vector2d(-0.2, -0.2));
  EXPECT_EQ(stats.status, Status::converged);
  // The last piece is straight.
  EXPECT_NEAR(arrived, 2, 1e-12);
}

// s = x^3 - x + 1/4 has folds at x = -+1/sqrt 3 and, started at x = -1.5, reaches 1 where x^3 - x = 3/4.
TEST(Path, PassesFolds) {
  double at = 0, arrived = 0;
  const PathSystem system{.residual =
                              [&](const Eigen::VectorXd& y) {
                                at = y(0);
                                return Eigen::VectorXd::Constant(1, y(0) * (y(0) * y(0) - 1) + 0.25 - y(1));
                              },
                          .jacobian = [&] { return Eigen::MatrixXd(Eigen::RowVector2d(3 * at * at - 1, -1)); },
                          .arrive =
                              [&](const Eigen::VectorXd& x) {
                                arrived = x(0);
                                return true;
                              }};
  const PathStats stats = follow_path(system, Eigen::Vector2d(-1.5, -1.625), {.longest_step = 0.02});
  EXPECT_EQ(stats.status, Status::converged);
  // x^3 - x = 3/4; interpolated over a step of at most 0.05 with curvature below 8 / (3 x^2 - 1).
  EXPECT_NEAR(arrived * (arrived * arrived - 1), 0.75, 1e-2);
}

TEST(Path, StopsAtItsBudget) {
  double at = 0;
  const PathSystem system{.residual =
                              [&](const Eigen::VectorXd& y) {
                                at = y(0);
                                return Eigen::VectorXd::Constant(1, std::sin(y(0)) / 2 - y(1));
                              },
                          .jacobian = [&] { return Eigen::MatrixXd(Eigen::RowVector2d(std::cos(at) / 2, -1)); },
                          .arrive = [](const Eigen::VectorXd&) { return true; }};
  // s = sin(x) / 2 never reaches 1.
  EXPECT_EQ(follow_path(system, Eigen::Vector2d(0, 0), {.max_jacobians = 30}).status, Status::iteration_limit);
}

}  // namespace
}  // namespace dovetail::numerics
