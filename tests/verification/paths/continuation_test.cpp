#include "paths/continuation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "paths/frequency_response.hpp"
#include "paths/steady_state.hpp"
#include "tests/verification/steady/gap_oscillator.hpp"

namespace dovetail::verification {
namespace {

const steady::Options kSteady{.harmonics = 7, .samples = 256, .tolerance = 1e-11};

// Half the peak-to-peak of the gap oscillator after `periods` of time integration (Runge-Kutta, 1000 steps a period)
// from a state of the branch. The force has a kink only, so the error of a step at it is O(dt^2) and dt = 6e-3.
double integrated_amplitude(const steady::State& from, double gap, double zeta, double force, int periods) {
  const double omega = from.omega;
  const int steps = 1000;
  const double dt = 2 * std::numbers::pi / omega / steps;
  std::array<double, 2> y{0, 0};
  const auto harmonics = (from.outputs.cols() - 1) / 2;
  y[0] = from.outputs(0, 0);
  for (Eigen::Index h = 1; h <= harmonics; ++h) {
    y[0] += from.outputs(0, 2 * h - 1);
    y[1] += omega * static_cast<double>(h) * from.outputs(0, 2 * h);
  }
  const auto rate = [&](double t, const std::array<double, 2>& at) {
    return std::array{at[1], force * std::cos(omega * t) - 2 * zeta * at[1] - at[0] - std::max(0.0, at[0] - gap)};
  };
  const auto moved = [](const std::array<double, 2>& a, const std::array<double, 2>& b, double s) {
    return std::array{a[0] + s * b[0], a[1] + s * b[1]};
  };
  double lowest = 0, highest = 0;
  for (int period = 0; period < periods; ++period) {
    lowest = highest = y[0];
    for (int i = 0; i < steps; ++i) {
      const double t = i * dt;
      const auto k1 = rate(t, y), k2 = rate(t + dt / 2, moved(y, k1, dt / 2)),
                 k3 = rate(t + dt / 2, moved(y, k2, dt / 2)), k4 = rate(t + dt, moved(y, k3, dt));
      for (std::size_t r = 0; r < 2; ++r) y[r] += dt / 6 * (k1[r] + 2 * k2[r] + 2 * k3[r] + k4[r]);
      lowest = std::min(lowest, y[0]);
      highest = std::max(highest, y[0]);
    }
  }
  return (highest - lowest) / 2;
}

struct Leaning {
  const char* name;
  double gap, force, from, to;
};

class Fold : public testing::TestWithParam<Leaning> {};

// What a sweep up and a sweep down see of a curve that leans over, and where they fall off it, against the branch.
TEST_P(Fold, SweepsFromBothSidesLieOnTheBranchAndFallOffAtItsTurns) {
  const Leaning& test = GetParam();
  const double zeta = 0.02;
  const auto model = condensed(gap_oscillator(test.gap, zeta, test.force));
  const branches::Branch branch = paths::continuation({model, {}, kSteady}, test.from, test.to);
  ASSERT_EQ(branch.status, Status::converged);
  EXPECT_EQ(branch.points.back().state.omega, test.to);
  ASSERT_EQ(branch.turns(), 2);
  std::vector<double> turns;
  for (std::size_t i = 0; i < branch.points.size(); ++i) {
    const branches::BranchPoint& point = branch.points[i];
    ASSERT_EQ(point.state.status, Status::converged);
    EXPECT_EQ(point.state.penalty_ratio, 1);
    if (point.is_turn) turns.push_back(point.state.omega);
    // Each point solves the equations of its frequency.
    const steady::State again = paths::steady_state({model, {}, kSteady}, point.state.omega, point.state.displacement);
    ASSERT_EQ(again.status, Status::converged);
    EXPECT_NEAR(again.amplitudes(0), point.state.amplitudes(0), 1e-7);
    if (i > 0) {
      EXPECT_GT(point.arc_length, branch.points[i - 1].arc_length);
    }
  }
  ASSERT_EQ(turns.size(), 2U);

  // Sweeps forwards and backwards: the first falls off at the first turn, the other at the second.
  const double step = 5e-4 * (test.to - test.from);
  for (const bool forward : {true, false}) {
    std::vector<double> omega;
    for (int i = 0; i <= 2000; ++i) omega.push_back(forward ? test.from + i * step : test.to - i * step);
    const std::vector<steady::State> sweep = paths::frequency_response({model, {}, kSteady}, omega);
    double fall = 0;
    for (std::size_t i = 1; i < sweep.size(); ++i) {
      ASSERT_EQ(sweep[i].status, Status::converged) << sweep[i].omega;
      const double change = std::abs(sweep[i].amplitudes(0) / sweep[i - 1].amplitudes(0) - 1);
      if (change > 0.1) {
        EXPECT_EQ(fall, 0) << "falls once";
        fall = sweep[i].omega;
        // Samples that change their state one by one make several turns of a step or so out of one, and the sweep
        // may fall off at another of them than the branch shows.
        EXPECT_NEAR(sweep[i].omega, turns[forward ? 0 : 1], 2.5 * std::abs(step));
      }
    }
    EXPECT_NE(fall, 0);
  }
}

TEST_P(Fold, TimeIntegrationStaysOnTheOuterBranches) {
  const Leaning& test = GetParam();
  const double zeta = 0.02;
  steady::Options fine = kSteady;
  fine.harmonics = 15;
  fine.samples = 1024;
  const auto model = condensed(gap_oscillator(test.gap, zeta, test.force));
  const branches::Branch branch = paths::continuation({model, {}, fine}, test.from, test.to);
  ASSERT_EQ(branch.status, Status::converged);
  int compared = 0;
  double lower = kInfinity, upper = 0;
  for (const branches::BranchPoint& point : branch.points)
    if (point.is_turn) {
      lower = std::min(lower, point.state.omega);
      upper = std::max(upper, point.state.omega);
    }
  for (const branches::BranchPoint& point : branch.points) {
    const bool two_answers = point.state.omega > lower + 2e-3 && point.state.omega < upper - 2e-3;
    if (!two_answers || point.turns == 1 || point.is_turn) continue;
    // Transients die out by exp(-zeta t): 250 periods leave 1e-12. The series of x converges by 1/h^4.
    const double amplitude = integrated_amplitude(point.state, test.gap, zeta, test.force, 250);
    EXPECT_NEAR(point.state.amplitudes(0) / amplitude, 1, 1e-4) << point.state.omega << " turns " << point.turns;
    ++compared;
  }
  EXPECT_GE(compared, 4);
}

INSTANTIATE_TEST_SUITE_P(GapOscillator, Fold,
                         testing::Values(Leaning{"ClearanceHardens", 1, 0.1, 0.8, 1.4},
                                         Leaning{"LossOfContactSoftens", -1, 0.25, 1.8, 0.9}),
                         [](const auto& suite) { return suite.param.name; });

TEST(Continuation, EqualsPlainSolvesWithFriction) {
  const auto model = condensed(rod(5));
  for (const bool up : {true, false}) {
    const branches::Branch branch =
        paths::continuation({model, {}, {.tolerance = 1e-11}}, up ? 1.0 : 4.0, up ? 4.0 : 1.0);
    ASSERT_EQ(branch.status, Status::converged);
    EXPECT_EQ(branch.turns(), 0);
    EXPECT_EQ(branch.points.back().state.omega, up ? 4.0 : 1.0);
    for (const branches::BranchPoint& point : branch.points) {
      const steady::State plain = paths::steady_state({model, {}, {.tolerance = 1e-11}}, point.state.omega);
      ASSERT_EQ(plain.status, Status::converged);
      EXPECT_NEAR(plain.amplitudes(0) / point.state.amplitudes(0), 1, 1e-8) << point.state.omega;
      EXPECT_NEAR(plain.friction_energy, point.state.friction_energy, 1e-8) << point.state.omega;
    }
  }
}

TEST(Continuation, ResolvesASharpPeakBetweenItsPoints) {
  // Damping 1e-4, stuck contact: the unknowns of the contact say nothing of the peak, the output does. Its peak is
  // F / (2 k zeta) high, and the largest of the points is within a change of 0.3 of it.
  reduction::ReducedModel still = gap_oscillator(10, 1e-4, 1e-3);
  const branches::Branch branch = paths::continuation({condensed(still), {}, kSteady}, 0.5, 1.5);
  ASSERT_EQ(branch.status, Status::converged);
  double highest = 0;
  for (const branches::BranchPoint& point : branch.points) highest = std::max(highest, point.state.amplitudes(0));
  EXPECT_GT(highest, 0.8 * 1e-3 / (2 * 1e-4));
}

// m = k = 1 between two stops at a clearance of 1, each of stiffness kn: dofs x, then u_N and u_T of either stop.
reduction::ReducedModel two_stops(double kn, double damping) {
  reduction::ReducedModel model = empty_model(5, 2, 1);
  model.mass(0, 0) = model.stiffness(0, 0) = 1;
  model.damping(0, 0) = damping;
  for (const int stop : {0, 1}) {
    const int normal = 1 + 2 * stop;
    const double towards = stop == 0 ? -kn : kn;
    model.stiffness(0, 0) += kn;
    model.stiffness(normal, normal) = kn;
    model.stiffness(normal + 1, normal + 1) = 1;
    model.stiffness(0, normal) = model.stiffness(normal, 0) = towards;
    model.contact.normal(stop) = normal;
    model.contact.tangential(stop, 0) = normal + 1;
  }
  model.contact.gap.setOnes();
  model.cosine_force(0, 0) = 0.3;
  model.output_vectors = Eigen::MatrixXd::Zero(1, 5);
  model.output_vectors(0, 0) = 1;
  model.output_names = {"x"};
  return model;
}

// At 128 samples the branch near the fold is a zigzag of pieces, in each of which the same samples touch: turns of up
// to 1 % of the interval, which fall with the number of samples. They are passed and not counted.
TEST(Continuation, PassesTheZigzagOfFewSamplesAtStiffStops) {
  struct Case {
    double kn, damping;
    int turns;  // 1: the branch that comes down leaves at the top again, 0: the upper branch reaches it
  };
  for (const Case& test : {Case{4, 0.04, 2}, Case{4, 0.01, 2}, Case{20, 0.04, 2}, Case{20, 0.01, 0}})
    for (const bool up : {true, false}) {
      const auto model = condensed(two_stops(test.kn, test.damping));
      const branches::Branch branch =
          paths::continuation({model, {}, {.harmonics = 3, .samples = 128}}, up ? 0.5 : 4, up ? 4 : 0.5);
      const bool back = test.turns == 0 && !up;
      SCOPED_TRACE(testing::Message() << test.kn << " " << test.damping << " " << up);
      ASSERT_EQ(branch.status, Status::converged);
      EXPECT_EQ(branch.turns(), back ? 1 : test.turns);
      EXPECT_EQ(branch.points.back().state.omega, up || back ? 4 : 0.5);
      EXPECT_LT(branch.points.size(), 1000U);
      int marked = 0;
      for (const branches::BranchPoint& point : branch.points) marked += point.is_turn ? 1 : 0;
      EXPECT_EQ(marked, branch.turns());
    }
}

TEST(Continuation, FindsTheSamePeakUpwardsAndDownwardsThroughAZigzag) {
  // The peak is a piece wide: 1 / samples of its height is what its sampling leaves open.
  const auto model = condensed(two_stops(4, 0.04));
  std::array<double, 2> highest{0, 0};
  for (const bool up : {true, false}) {
    const branches::Branch branch =
        paths::continuation({model, {}, {.harmonics = 5, .samples = 128}}, up ? 0.5 : 4, up ? 4 : 0.5);
    ASSERT_EQ(branch.status, Status::converged);
    for (const branches::BranchPoint& point : branch.points)
      highest[up ? 1 : 0] = std::max(highest[up ? 1 : 0], point.state.amplitudes(0));
  }
  EXPECT_NEAR(highest[0] / highest[1], 1, 1.0 / 128);
}

TEST(FrequencyResponse, ReachesAFrequencyOverSmallerSteps) {
  // A step from far below onto the upper branch near its end: from the predictor it does not get there.
  const auto model = condensed(gap_oscillator(1, 0.02, 0.1));
  const std::vector<double> omega{1.0, 1.085};
  const std::vector<steady::State> states = paths::frequency_response({model, {}, kSteady}, omega);
  for (const steady::State& state : states) {
    ASSERT_EQ(state.status, Status::converged);
    EXPECT_GE(state.iterations, 1);
    EXPECT_GE(state.intermediate, 0);
  }
}

}  // namespace
}  // namespace dovetail::verification
