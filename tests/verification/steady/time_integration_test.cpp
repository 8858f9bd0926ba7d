#include "tests/verification/steady/time_integration.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "paths/steady_state.hpp"
#include "tests/verification/steady/rod.hpp"

namespace dovetail::verification {
namespace {

using steady::State;

// Two masses of `d` directions on springs, one massless contact node behind a tilted spring at each: pressed by
// `press`, excited by `force` at the first mass in all directions with different phases.
reduction::ReducedModel pair_of_masses(int d, double friction, double press, double force) {
  reduction::ReducedModel model = empty_model(4 * d, 2, d - 1);
  Eigen::Matrix3d link, ground, spring;
  link << 0.8, 0.1, 0.05, 0.1, 0.6, 0.1, 0.05, 0.1, 0.7;
  ground << 1, 0.2, 0.1, 0.2, 1.4, 0.1, 0.1, 0.1, 1.1;
  spring << 3, 0.4, 0.2, 0.4, 2, 0.3, 0.2, 0.3, 1.6;
  for (int m = 0; m < 2; ++m) {
    const Eigen::Index q = m * d, u = (2 + m) * d;
    const Eigen::Matrix3d turn = (Eigen::AngleAxisd(0.5 + m, Eigen::Vector3d::UnitZ()) *
                                  Eigen::AngleAxisd(d == 3 ? 0.4 : 0, Eigen::Vector3d::UnitX()))
                                     .toRotationMatrix();
    const Eigen::MatrixXd r = turn.topLeftCorner(d, d), k = spring.topLeftCorner(d, d);
    model.mass.block(q, q, d, d) = (1 + 0.5 * m) * Eigen::MatrixXd::Identity(d, d);
    model.damping.block(q, q, d, d) = 0.08 * Eigen::MatrixXd::Identity(d, d);
    model.stiffness.block(q, q, d, d) += ground.topLeftCorner(d, d) + link.topLeftCorner(d, d) + r.transpose() * k * r;
    model.stiffness.block(u, u, d, d) = k;
    model.stiffness.block(u, q, d, d) = -k * r;
    model.stiffness.block(q, u, d, d) = -r.transpose() * k;
    model.stiffness.block(q, (1 - m) * d, d, d) -= link.topLeftCorner(d, d);
    model.contact.normal(m) = static_cast<int>(u);
    for (int t = 1; t < d; ++t) model.contact.tangential(m, t - 1) = static_cast<int>(u + t);
    model.contact.friction(m) = friction;
    model.static_force(u) = press * (1 + 0.3 * m);
  }
  for (int t = 0; t < d; ++t) {
    model.cosine_force(0, t) = force * std::cos(0.7 * t);
    model.sine_force(0, t) = force * std::sin(0.7 * t);
  }
  model.output_vectors = Eigen::MatrixXd::Identity(1, 4 * d);
  model.output_names = {"x"};
  return model;
}

// A mass on a spring before a stop: a massless node behind a spring, at a gap, its tangential direction idle.
reduction::ReducedModel stop(double gap, double force) {
  reduction::ReducedModel model = empty_model(3, 1, 1);
  const double spring = 5;
  model.mass(0, 0) = 1;
  model.damping(0, 0) = 0.1;
  model.stiffness << 1 + spring, -spring, 0, -spring, spring, 0, 0, 0, 1;
  model.contact.normal << 1;
  model.contact.tangential << 2;
  model.contact.friction << 0.3;
  model.contact.gap << gap;
  model.cosine_force(0, 0) = force;
  model.output_vectors = Eigen::MatrixXd::Identity(1, 3);
  model.output_names = {"x"};
  return model;
}

// Energies of a period by both. Nodes that stay stuck keep what the transient left them: the engine starts its contact
// law there. 2048 steps leave 1e-5 or less of the time integration's energies (from 8192), the series at the harmonics
// given 2e-5.
void expect_same(reduction::ReducedModel model, double omega, int harmonics, bool separates) {
  const Periodic motion = march_in_time(model, omega, 2048);
  ASSERT_GT(motion.periods, 0);
  ASSERT_EQ(motion.separates, separates);
  model.contact.slip_origin = motion.slip_end;
  const steady::State state =
      paths::steady_state({condensed(model),
                           {},
                           {.harmonics = harmonics, .samples = 4096, .slip_return = contact::SlipReturn::second_order}},
                          omega);
  ASSERT_EQ(state.status, Status::converged);
  EXPECT_NEAR(state.input_energy / motion.input_energy, 1, 1e-4);
  EXPECT_NEAR(state.damping_energy / motion.damping_energy, 1, 1e-4);
  EXPECT_NEAR(state.friction_energy, motion.friction_energy, 1e-4 * motion.input_energy);
  if (motion.slips) {
    EXPECT_NEAR(state.friction_energy / motion.friction_energy, 1, 1e-4);
  }
}

TEST(TimeIntegration, OfTheSingleNodeHasTheKnownFrictionEnergy) {
  const Periodic motion = march_in_time(single_node(), 1.1, 2048);
  ASSERT_GT(motion.periods, 0);
  // Second order: 5.9e-5, 1.5e-5, 4.2e-6 measured with 512, 1024, 2048 steps.
  EXPECT_NEAR(motion.friction_energy / 11.4313802832, 1, 6e-6);
}

TEST(TimeIntegration, AgreesOnSlipInOneDirection) {
  expect_same(rod(3), 2.5, 31, false);
  expect_same(pair_of_masses(2, 0.4, 2, 1), 1.3, 31, false);
  expect_same(pair_of_masses(2, 0.4, 2, 2), 1.3, 31, false);
}

TEST(TimeIntegration, AgreesOnSlipInTwoDirections) {
  expect_same(single_node(), 1.1, 31, false);
  expect_same(pair_of_masses(3, 0.3, 2, 1), 1.3, 31, false);
  expect_same(pair_of_masses(3, 0.5, 2, 1), 1.0, 31, false);
}

TEST(TimeIntegration, AgreesOnLiftOffWithoutFriction) {
  expect_same(stop(0.2, 1), 1.2, 31, true);
  expect_same(stop(0.5, 1), 0.8, 31, true);
}

TEST(TimeIntegration, AgreesOnLiftOffWithSlip) {
  expect_same(pair_of_masses(2, 0.2, 0.5, 1.5), 1.8, 63, true);
  expect_same(pair_of_masses(3, 0.3, 1, 1.5), 0.9, 31, true);
  expect_same(stop(0.1, 0.7), 1.6, 31, true);
}

}  // namespace
}  // namespace dovetail::verification
