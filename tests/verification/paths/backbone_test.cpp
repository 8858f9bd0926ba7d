#include "paths/backbone.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "paths/continuation.hpp"
#include "paths/steady_state.hpp"
#include "tests/verification/steady/gap_oscillator.hpp"

namespace dovetail::verification {
namespace {

// Both searches stop when the correction left is 0.2 of this: their answers differ by less than 1e-7.
const paths::BackboneOptions kTight{.resonance = {.frequency_tolerance = 2e-8}};
const steady::Options kOnPeaks{.harmonics = 5, .samples = 256, .tolerance = 1e-11};

// Every point against paths::resonance() started anew beside it; returns the Jacobians paths::resonance() took.
int expect_resonances(const paths::Backbone& backbone, const paths::BackboneFamily& family) {
  int jacobians = 0;
  EXPECT_EQ(backbone.status, Status::converged);
  for (const paths::BackbonePoint& point : backbone.points) {
    const steady::Joint joint = family(point.parameter);
    const paths::Resonance again = paths::resonance(joint, point.omega * 1.003, kTight.resonance);
    EXPECT_EQ(again.status, Status::converged) << point.parameter;
    EXPECT_NEAR(point.omega / again.omega, 1, 1e-7) << point.parameter;
    EXPECT_NEAR(point.amplitude / again.amplitude, 1, 1e-8) << point.parameter;
    EXPECT_EQ(point.state.omega, point.omega);
    EXPECT_LE(point.error, 1e-7);
    jacobians += again.jacobians;
  }
  return jacobians;
}

std::vector<double> levels(double from, double to, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(from + (to - from) * i / (count - 1));
  return values;
}

// Two masses in x and y behind springs on one massless contact node that slides all the time: forced round, the contact
// never sticks, no sample changes its state and the response is a smooth function of everything. Normal force N_0 - W.
reduction::ReducedModel sliding_orbit() {
  reduction::ReducedModel model = empty_model(5, 1, 2);
  model.mass.topLeftCorner<2, 2>().setIdentity();
  model.damping.topLeftCorner<2, 2>() = 0.05 * Eigen::Matrix2d::Identity();
  model.stiffness.diagonal() << 2, 2.3, 1, 1, 1;
  for (const int r : {0, 1}) model.stiffness(r, 2 + r) = model.stiffness(2 + r, r) = -1;
  model.contact.tangential << 2, 3;
  model.contact.normal << 4;
  model.contact.friction << 0.5;
  model.static_force(4) = 1;
  model.cosine_force(0, 0) = 1;
  model.sine_force(0, 1) = 1;
  model.output_vectors = Eigen::MatrixXd::Zero(1, 5);
  model.output_vectors(0, 0) = 1;
  model.output_names = {"x"};
  return model;
}

void expect_tracked(const paths::Backbone& backbone, int searching) {
  int tracking = 0;
  for (std::size_t i = 1; i < backbone.points.size(); ++i) {
    EXPECT_FALSE(backbone.points[i].searched) << backbone.points[i].parameter;
    EXPECT_TRUE(backbone.points[i].state.nodes.front().slips);
    tracking += backbone.points[i].jacobians;
  }
  testing::Test::RecordProperty("jacobians_tracking", tracking);
  testing::Test::RecordProperty("jacobians_searching", searching);
  EXPECT_LT(tracking, 0.6 * searching);
}

TEST(Backbone, OfExcitationLevelsIsItsResonances) {
  const paths::BackboneFamily family = paths::excitation_levels({condensed(sliding_orbit()), {}, kOnPeaks});
  const paths::Backbone found = paths::backbone(family, levels(1, 3, 17), 1.05, kTight);
  expect_tracked(found, expect_resonances(found, family));
}

TEST(Backbone, OfWearIsItsResonances) {
  const paths::BackboneFamily family =
      paths::wear_levels({condensed(sliding_orbit()), {}, kOnPeaks}, Eigen::VectorXd::Constant(1, 0.6));
  const paths::Backbone found = paths::backbone(family, levels(0, 1, 13), 1.05, kTight);
  expect_tracked(found, expect_resonances(found, family));
  // The normal force falls: less friction, a higher peak.
  EXPECT_GT(found.points.back().amplitude, found.points.front().amplitude);
}

TEST(Backbone, OfSpeedGoesThroughAModelOfItsOwn) {
  // Stiffness and preload grow with the square of the speed: the model itself is a function of the parameter.
  const paths::BackboneFamily family = [](double speed) {
    reduction::ReducedModel model = sliding_orbit();
    model.stiffness.topLeftCorner<2, 2>() += 0.2 * speed * speed * Eigen::Matrix2d::Identity();
    model.static_force(4) = 1 + 0.5 * speed * speed;
    return steady::Joint{condensed(model), {}, kOnPeaks};
  };
  const paths::Backbone found = paths::backbone(family, levels(0, 1, 11), 1.05, kTight);
  expect_tracked(found, expect_resonances(found, family));
  EXPECT_GT(found.points.back().omega, found.points.front().omega);
}

// Nothing beside a point is higher, but for what a frequency known to 1e-7 leaves open on flanks where ln A changes
// with ln w by less than 1. A point on a flank, a few tenths steep, would be lower than what is 1e-6 beside it by more.
void expect_maximum(const steady::Joint& joint, const paths::BackbonePoint& point) {
  for (const double beside : {1 - 1e-6, 1 + 1e-6}) {
    const steady::State near = paths::steady_state(joint, point.omega * beside, point.state.displacement);
    ASSERT_EQ(near.status, Status::converged);
    EXPECT_LE(near.amplitudes(0), point.amplitude * (1 + 1e-7)) << point.parameter << " beside " << beside;
  }
}

// Where samples change their contact state the slope of the amplitude jumps, and near its maximum there are several,
// some 1 / N of the width of the peak apart: each search ends on one of them. That one is a maximum, and no other is
// higher by more than the same share.
void expect_maxima(const paths::Backbone& backbone, const paths::BackboneFamily& family) {
  EXPECT_EQ(backbone.status, Status::converged);
  for (const paths::BackbonePoint& point : backbone.points) {
    const steady::Joint joint = family(point.parameter);
    expect_maximum(joint, point);
    const paths::Resonance again = paths::resonance(joint, point.omega * 1.003, kTight.resonance);
    ASSERT_EQ(again.status, Status::converged);
    EXPECT_NEAR(again.amplitude / point.amplitude, 1, 1.0 / joint.options.samples) << point.parameter;
  }
}

TEST(Backbone, OfAHardeningGapIsMadeOfMaxima) {
  const paths::BackboneFamily family = paths::excitation_levels({condensed(gap_oscillator(1, 0.02, 1)), {}, kOnPeaks});
  const paths::Backbone found = paths::backbone(family, levels(0.03, 0.12, 12), 1.0, kTight);
  expect_maxima(found, family);
  // Linear until the gap closes at F = 2 zeta = 0.04, then the peak moves up.
  EXPECT_NEAR(found.points.front().omega, std::sqrt(1 - 2 * 0.02 * 0.02), 1e-7);
  EXPECT_GT(found.points.back().omega, 1.09);
}

TEST(Backbone, OfARodThatWearsIsMadeOfMaxima) {
  const paths::BackboneFamily family =
      paths::wear_levels({condensed(rod(5)), {}, kOnPeaks}, Eigen::VectorXd::LinSpaced(5, 0.5, 0.1));
  const paths::Backbone found = paths::backbone(family, levels(0, 1, 11), 3.0, kTight);
  expect_maxima(found, family);
}

// With more excitation all nodes of the rod slip and its peak goes from 0.42 Hz to 0.24 Hz, over several maxima of like
// height on the way. Whichever way the levels are gone through, each point is the largest of a fine sweep.
TEST(Backbone, IsTheLargestPeakWhicheverWayItIsFollowed) {
  const paths::BackboneFamily family = paths::excitation_levels({condensed(rod(10))});
  // Maxima of the sampled equations beside each other differ by 1 / samples.
  const double noise = 1.0 / steady::Options{}.samples;
  for (const auto& way : {levels(1, 2, 11), levels(2, 1, 11)}) {
    const paths::Backbone found = paths::backbone(family, way, 2.8);
    ASSERT_EQ(found.status, Status::converged);
    for (const paths::BackbonePoint& point : found.points) {
      const steady::Joint joint = family(point.parameter);
      double highest = 0;
      const branches::Branch sweep = paths::continuation(joint, 0.8, 4.2, {.largest_parameter_step = 0.005});
      ASSERT_EQ(sweep.status, Status::converged);
      for (const branches::BranchPoint& at : sweep.points) highest = std::max(highest, at.state.amplitudes(0));
      EXPECT_TRUE(point.checked);
      EXPECT_NEAR(point.amplitude / highest, 1, noise) << point.parameter << " from " << way.front();
    }
  }
}

// On the way to a maximum a secant of the slope that passes one of its jumps is as steep as the points are close: the
// step it proposes is small, wherever the maximum is.
TEST(Backbone, IsMadeOfMaximaWhereTheSlopeJumps) {
  for (const auto& [nodes, forces] : {std::pair{3, levels(0.5, 2, 16)}, {10, levels(1, 2, 5)}, {10, {1.7, 1.75}}}) {
    const paths::BackboneFamily family = paths::excitation_levels({condensed(rod(nodes)), {}, {}});
    for (const double range : {paths::BackboneOptions{}.check_range, 0.0}) {
      const paths::Backbone found = paths::backbone(family, forces, 3.0, {.check_range = range});
      ASSERT_EQ(found.status, Status::converged);
      for (const paths::BackbonePoint& point : found.points) expect_maximum(family(point.parameter), point);
    }
  }
}

TEST(Backbone, SaysWhereItLeftThePeakItFollowed) {
  // Started at 0.41 Hz, where there is a side maximum at level 2.
  const paths::BackboneFamily family = paths::excitation_levels({condensed(rod(10))});
  const std::vector<double> level{2};
  paths::BackboneOptions follow;
  const paths::Backbone largest = paths::backbone(family, level, 2.6, follow);
  follow.check_range = 0;
  const paths::Backbone side = paths::backbone(family, level, 2.6, follow);
  ASSERT_EQ(largest.status, Status::converged);
  ASSERT_EQ(side.status, Status::converged);
  EXPECT_TRUE(largest.points.front().jumped);
  EXPECT_FALSE(side.points.front().jumped);
  EXPECT_FALSE(side.points.front().checked);
  EXPECT_LT(side.points.front().amplitude, 0.7 * largest.points.front().amplitude);
}

// Without damping and with more force than friction takes up, the peak at 0.238 Hz has no end; what is found are side
// maxima further away than the range of the check, towards whose end the amplitude rises.
TEST(Backbone, SaysWhereTheAmplitudeRisesBeyondTheRange) {
  reduction::ReducedModel undamped = rod(10);
  undamped.damping *= 0;
  const paths::BackboneFamily family = paths::excitation_levels({condensed(undamped)});
  for (const auto& forces : {std::vector{3.0}, levels(2, 3, 9)})
    for (const paths::BackbonePoint& point : paths::backbone(family, forces, 2.8).points)
      EXPECT_EQ(point.status == Status::converged && point.checked, point.parameter < 2.8)
          << point.parameter << ": " << point.omega << " " << point.amplitude;
}

TEST(Backbone, StopsWhenAsked) {
  const paths::BackboneFamily family = paths::excitation_levels({condensed(sliding_orbit()), {}, kOnPeaks});
  const paths::Backbone found = paths::backbone(
      family, levels(1, 2, 4), 1.05, kTight, [](const paths::BackbonePoint& point) { return point.parameter < 1.1; });
  EXPECT_EQ(found.status, Status::interrupted);
  ASSERT_EQ(found.points.size(), 4U);
  EXPECT_EQ(found.points[1].status, Status::converged);
  EXPECT_EQ(found.points[2].status, Status::interrupted);
}

}  // namespace
}  // namespace dovetail::verification
