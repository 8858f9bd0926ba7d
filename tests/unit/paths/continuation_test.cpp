#include "paths/continuation.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "tests/verification/steady/gap_oscillator.hpp"

namespace dovetail {
namespace {

using verification::condensed;
using verification::gap_oscillator;

TEST(Continuation, EndsExactlyWhereAskedInBothDirections) {
  const auto model = condensed(gap_oscillator(1, 0.05, 0.05));
  for (const auto& [from, to] : {std::pair{0.7, 1.31}, std::pair{1.31, 0.7}}) {
    const branches::Branch branch = paths::continuation({model, {}, {}}, from, to);
    ASSERT_EQ(branch.status, Status::converged);
    EXPECT_EQ(branch.points.front().state.omega, from);
    EXPECT_EQ(branch.points.back().state.omega, to);
    for (const branches::BranchPoint& point : branch.points) EXPECT_EQ(point.direction > 0, to > from);
  }
}

TEST(Continuation, KeepsItsStepsWithinTheirLimits) {
  const auto model = condensed(gap_oscillator(1, 0.05, 0.05));
  const branches::FollowOptions options{.largest_parameter_step = 0.01};
  const branches::Branch branch = paths::continuation({model, {}, {}}, 0.5, 0.7, options);
  ASSERT_EQ(branch.status, Status::converged);
  ASSERT_GE(branch.points.size(), 100U);
  for (std::size_t i = 1; i < branch.points.size(); ++i)
    EXPECT_LE(branch.points[i].state.omega - branch.points[i - 1].state.omega, 0.01 * 0.2 * (1 + 1e-9));
}

TEST(Continuation, SaysWhyItEndedEarly) {
  const auto model = condensed(gap_oscillator(1, 0.05, 0.05));
  const branches::Branch limited = paths::continuation({model, {}, {}}, 0.5, 1.5, {.max_points = 4});
  EXPECT_EQ(limited.status, Status::iteration_limit);
  EXPECT_EQ(limited.points.size(), 4U);
  const branches::Branch stopped = paths::continuation(
      {model, {}, {}}, 0.5, 1.5, {}, [](const branches::BranchPoint& point) { return point.arc_length < 0.1; });
  EXPECT_EQ(stopped.status, Status::interrupted);
  EXPECT_GE(stopped.points.back().arc_length, 0.1);
}

TEST(Continuation, RefusesBadInput) {
  const auto model = condensed(gap_oscillator(1, 0.05, 0.05));
  EXPECT_THROW(static_cast<void>(paths::continuation({model, {}, {}}, 1, 1)), InputError);
  EXPECT_THROW(static_cast<void>(paths::continuation({model, {}, {}}, -1, 1)), InputError);
  EXPECT_THROW(static_cast<void>(paths::continuation({model, {}, {}}, 1, 2, {.largest_change = 0})), InputError);
  EXPECT_THROW(static_cast<void>(paths::continuation({model, {}, {.harmonics = 0}}, 1, 2)), InputError);
}

TEST(Tangent, KnowsTheSignOfItsDeterminant) {
  // Of J along a branch that leans over: it changes where the frequency turns, and nowhere else.
  const steady::Options options{.harmonics = 7, .samples = 256, .tolerance = 1e-11};
  const branches::Branch branch = paths::continuation({condensed(gap_oscillator(1, 0.02, 0.1)), {}, options}, 0.8, 1.4);
  ASSERT_EQ(branch.turns(), 2);
  for (const branches::BranchPoint& point : branch.points) {
    if (point.is_turn) continue;
    ASSERT_TRUE(point.state.tangent);
    const steady::Tangent& linear = *point.state.tangent;
    const Eigen::MatrixXd jacobian = steady::jacobian(linear.point());
    const double scale = jacobian.cwiseAbs().maxCoeff();
    const double determinant = Eigen::PartialPivLU<Eigen::MatrixXd>(jacobian / scale).determinant();
    EXPECT_EQ(linear.factors().determinant_sign(), determinant > 0 ? 1 : -1) << point.state.omega;
    EXPECT_EQ(linear.factors().determinant_sign() > 0, point.turns % 2 == 0) << point.state.omega;
    EXPECT_EQ(point.direction > 0, point.turns % 2 == 0) << point.state.omega;
  }
}

TEST(DenseLu, KnowsTheSignOfItsDeterminant) {
  Eigen::MatrixXd matrix(3, 3);
  matrix << 0, 2, 1, 1, 0, 3, 4, 1, 0;  // det = 25
  EXPECT_EQ(numerics::DenseLu(matrix).determinant_sign(), 1);
  matrix.row(0).swap(matrix.row(2));
  EXPECT_EQ(numerics::DenseLu(matrix).determinant_sign(), -1);
  matrix.row(0).setZero();
  EXPECT_EQ(numerics::DenseLu(matrix).determinant_sign(), 0);
}

}  // namespace
}  // namespace dovetail
