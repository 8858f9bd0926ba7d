#include "branches/follow.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "steady/solve.hpp"
#include "tests/verification/steady/gap_oscillator.hpp"

namespace dovetail::branches {
namespace {

// The gap oscillator over the level s of its force at a fixed frequency above its resonance: linear, x = s F / |S|,
// until x reaches the gap, then back to the level that damping takes at the large amplitude, then up.
constexpr double kOmega = 1.1, kZeta = 0.02, kGap = 1;

class ForceLevel : public testing::Test {
 protected:
  ForceLevel() { problem_ = at(kLevel); }

  [[nodiscard]] std::shared_ptr<const steady::Problem> at(double level) const {
    const steady::Joint joint{.model = verification::condensed(verification::gap_oscillator(kGap, kZeta, level)),
                              .condition = {},
                              .options = joint_.options};
    return std::make_shared<const steady::Problem>(
        joint, std::make_shared<const dynamics::HarmonicSystem>(
                   dynamics::harmonic_system(*joint.model, joint.options.harmonics, kOmega)));
  }

  // From the linear response at a level of 0.13.
  [[nodiscard]] Branch followed(double to, double back, const FollowOptions& options = {}) const {
    const Equations equations(
        joint_.options, [this](double level) { return at(level); },
        [this](const steady::Point& point) {
          const Eigen::MatrixXd& force = problem_->system().force;
          return Eigen::MatrixXd(steady::apply_force_derivative(point, force) - force);
        });
    const std::shared_ptr<const steady::Problem> first = at(kFrom);
    steady::Attempt start = steady::solve(first, Eigen::MatrixXd::Zero(2, 2 * joint_.options.harmonics + 1),
                                          steady::Method::newton, joint_.options.max_iterations);
    return follow(equations, described(std::move(start.point), start.status, steady::AtSolution::linearise),
                  {.from = kFrom, .to = to, .back = back}, options);
  }

  static constexpr double kFrom = 0.13, kLevel = 1;
  const steady::Joint joint_{.model = verification::condensed(verification::gap_oscillator(kGap, kZeta, kLevel)),
                             .condition = {},
                             .options = {.harmonics = 7, .samples = 256, .tolerance = 1e-11}};
  std::shared_ptr<const steady::Problem> problem_;
};

TEST_F(ForceLevel, IsFollowedThroughItsTurns) {
  const Branch branch = followed(0.4, -kInfinity);
  ASSERT_EQ(branch.status, Status::converged);
  EXPECT_EQ(branch.points.front().parameter, kFrom);
  EXPECT_EQ(branch.points.back().parameter, 0.4);
  EXPECT_EQ(branch.turns(), 2);
  // |S| of the linear oscillator.
  const double stiffness = std::hypot(1 - kOmega * kOmega, 2 * kZeta * kOmega);
  double highest = 0, lowest = 1;
  for (const BranchPoint& point : branch.points) {
    ASSERT_EQ(point.state.status, Status::converged);
    if (!point.is_turn) {
      EXPECT_EQ(point.direction > 0, point.turns % 2 == 0) << point.parameter;
    }
    if (point.turns == 0 && point.parameter < stiffness * kGap) {
      EXPECT_NEAR(point.state.amplitudes(0), point.parameter / stiffness, 1e-9);
    }
    if (point.turns == 0) highest = std::max(highest, point.parameter);
    lowest = std::min(lowest, point.parameter);
  }
  // The branch turns a little after the gap has closed.
  EXPECT_GT(highest, stiffness * kGap);
  EXPECT_LT(highest, 1.1 * stiffness * kGap);
  // Where it turns again the force does what damping takes: s F = 2 zeta omega x with x > gap; the impacts' higher
  // harmonics take some more.
  EXPECT_GT(lowest, 2 * kZeta * kOmega * kGap);
}

TEST_F(ForceLevel, LeavesByTheOtherEndWhenItComesBack) {
  for (const double back : {0.13, 0.12}) {
    const Branch branch = followed(0.4, back);
    ASSERT_EQ(branch.status, Status::converged);
    EXPECT_EQ(branch.points.back().parameter, back);
    EXPECT_EQ(branch.turns(), 1);
    EXPECT_GT(branch.points.back().state.amplitudes(0), kGap);
  }
}

TEST_F(ForceLevel, StopsAtItsLimits) {
  const Branch points = followed(0.4, -kInfinity, {.max_points = 5});
  EXPECT_EQ(points.status, Status::iteration_limit);
  EXPECT_EQ(points.points.size(), 5U);
  const Branch jacobians = followed(0.4, -kInfinity, {.max_jacobians = 10});
  EXPECT_EQ(jacobians.status, Status::iteration_limit);
  EXPECT_GE(jacobians.jacobians, 10);
  EXPECT_LT(jacobians.jacobians, 10 + 2 * FollowOptions().max_corrections);
  EXPECT_THROW(static_cast<void>(followed(0.4, 0.13, {.max_points = 1})), InputError);
}

TEST_F(ForceLevel, HandsAStartBackThatIsNone) {
  const Equations nowhere(
      joint_.options, [](double) { return std::shared_ptr<const steady::Problem>(); },
      [](const steady::Point& point) { return point.displacement; });
  const Branch branch = follow(nowhere, {}, {.from = 1, .to = 2, .back = 1});
  EXPECT_EQ(branch.status, Status::iteration_limit);
  ASSERT_EQ(branch.points.size(), 1U);
  EXPECT_EQ(branch.points.front().parameter, 1);
}

}  // namespace
}  // namespace dovetail::branches
