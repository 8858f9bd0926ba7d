#include "tractions/traction_bounds.hpp"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>
#include <random>

#include "paths/steady_state.hpp"
#include "tests/verification/steady/rod.hpp"
#include "tractions/slip_origin_sensitivity.hpp"

namespace dovetail::verification {
namespace {

using steady::Options;
using steady::State;
using tractions::BoundedQuantity;
using tractions::TractionBounds;

// Three modes and massless nodes (N, T) on a random elastic body: what a node carries tangentially changes the normal
// forces of all. The first `stuck` nodes have so much friction that they never slip while |m| is small.
reduction::ReducedModel elastic(int nodes, int stuck, unsigned seed, double load = 1) {
  constexpr int kModes = 3;
  const Eigen::Index n = kModes + 2 * nodes;
  reduction::ReducedModel model = empty_model(n, nodes, 1);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Eigen::MatrixXd root(n, n);
  for (double& value : root.reshaped()) value = uniform(random);
  const Eigen::MatrixXd q = root.householderQr().householderQ();
  Eigen::VectorXd stiffness = Eigen::VectorXd::LinSpaced(n, 1, 6);
  model.stiffness = q * stiffness.asDiagonal() * q.transpose();
  model.stiffness = (model.stiffness + model.stiffness.transpose()).eval() / 2;
  for (int i = 0; i < kModes; ++i) {
    model.mass(i, i) = 1;
    model.damping(i, i) = 0.05;
  }
  for (int i = 0; i < nodes; ++i) {
    model.contact.normal(i) = kModes + 2 * i;
    model.contact.tangential(i, 0) = kModes + 2 * i + 1;
    model.static_force(kModes + 2 * i) = 1;
    model.contact.friction(i) = i < stuck ? 0.8 : 0.05;
  }
  model.contact.wear_coefficient.setConstant(1e-3);
  model.cosine_force(0, 0) = 0.5 * load;
  model.cosine_force(0, 1) = 0.2 * load;
  model.sine_force(0, 2) = 0.3 * load;
  model.output_vectors = Eigen::MatrixXd::Zero(1, n);
  model.output_vectors(0, 0) = 1;
  model.output_names = {"mode"};
  return model;
}

double value_of(const reduction::ReducedModel& model, const steady::State& state, tractions::BoundedQuantity quantity) {
  if (quantity == tractions::BoundedQuantity::friction_energy) return state.friction_energy;
  if (quantity == tractions::BoundedQuantity::wear_rate) return model.contact.area.dot(state.wear_rate);
  return state.amplitudes(0);
}

const steady::Options kOptions{.harmonics = 3, .samples = 128, .tolerance = 1e-11};
constexpr double kOmega = 1.2;

TEST(SlipOrigin, DerivativesMatchDifferences) {
  const reduction::ReducedModel model = elastic(4, 2, 3);
  const auto reduced = condensed(model);
  const steady::State state = paths::steady_state({reduced, {}, kOptions}, kOmega);
  ASSERT_EQ(state.status, Status::converged);
  ASSERT_TRUE(state.nodes[0].stuck && state.nodes[1].stuck);
  ASSERT_GT(state.friction_energy, 0);
  const Eigen::MatrixXd amplitude = tractions::amplitude_to_slip_origin(state, 0);
  const Eigen::MatrixXd energy =
      tractions::slip_to_slip_origin(state, {.load = Eigen::VectorXd::Zero(4), .energy = Eigen::VectorXd::Ones(4)});
  for (Eigen::Index i = 0; i < 4; ++i) {
    Eigen::MatrixXd step = Eigen::MatrixXd::Zero(4, 1);
    step(i, 0) = 1e-6;
    const steady::State above =
        paths::steady_state({reduced, {.slip_origin = step}, kOptions}, kOmega, state.displacement);
    const steady::State below =
        paths::steady_state({reduced, {.slip_origin = -step}, kOptions}, kOmega, state.displacement);
    // Residuals of 1e-11 over the step of 2e-6; the second derivative is O(1).
    EXPECT_NEAR(amplitude(i, 0), (above.amplitudes(0) - below.amplitudes(0)) / 2e-6, 2e-5) << i;
    EXPECT_NEAR(energy(i, 0), (above.friction_energy - below.friction_energy) / 2e-6, 2e-5) << i;
    const Eigen::MatrixXd predicted = tractions::response_to_slip_origin(state, step);
    EXPECT_LT((above.displacement - state.displacement - predicted).norm(), 1e-9) << i;
  }
  EXPECT_GT(amplitude.topRows(2).norm(), 1e-4);
  EXPECT_EQ(amplitude.bottomRows(2).norm(), 0);
}

class OneQuantity : public testing::TestWithParam<tractions::BoundedQuantity> {};

// A grid over slip origins wide enough for the traction to saturate on both sides. The bounds may only be wider than
// the grid by what it misses between its points (a value changes by less than 2 % of its range from one to the next).
TEST_P(OneQuantity, IsBoundedLikeAGridOverOneTraction) {
  const reduction::ReducedModel model = elastic(3, 1, 6);
  const auto reduced = condensed(model);
  const tractions::TractionBounds bounds = tractions::traction_bounds({reduced, {}, kOptions}, kOmega, GetParam());
  ASSERT_EQ(bounds.status, Status::converged) << bounds.reason;
  ASSERT_EQ(bounds.stuck_nodes, 1);
  double smallest = 1e300, largest = -1e300;
  steady::State state;
  for (int p = -60; p <= 60; ++p) {
    Eigen::MatrixXd origin = Eigen::MatrixXd::Zero(3, 1);
    origin(0, 0) = 0.02 * p;
    state = paths::steady_state({reduced, {.slip_origin = origin}, kOptions}, kOmega, state.displacement);
    if (state.status != Status::converged) continue;
    const double value = value_of(model, state, GetParam());
    smallest = std::min(smallest, value);
    largest = std::max(largest, value);
  }
  const double range = largest - smallest;
  EXPECT_LE(bounds.minimum.value, smallest + 1e-4 * range);
  EXPECT_GE(bounds.maximum.value, largest - 1e-4 * range);
  EXPECT_GE(bounds.minimum.value, smallest - 0.02 * range);
  EXPECT_LE(bounds.maximum.value, largest + 0.02 * range);
  EXPECT_GT(range, 1e-3 * largest);
}

TEST_P(OneQuantity, IsBoundedLikeAGridOverTwoTractions) {
  const reduction::ReducedModel model = elastic(3, 1, 3);
  const auto reduced = condensed(model);
  const tractions::TractionBounds bounds = tractions::traction_bounds({reduced, {}, kOptions}, kOmega, GetParam());
  ASSERT_EQ(bounds.status, Status::converged) << bounds.reason;
  ASSERT_EQ(bounds.stuck_nodes, 2);
  double smallest = 1e300, largest = -1e300;
  steady::State state;
  for (int p = -8; p <= 8; ++p)
    for (int q = -8; q <= 8; ++q) {
      Eigen::MatrixXd origin = Eigen::MatrixXd::Zero(3, 1);
      origin(0, 0) = 0.12 * p;
      origin(2, 0) = 0.12 * q;
      state = paths::steady_state({reduced, {.slip_origin = origin}, kOptions}, kOmega, state.displacement);
      if (state.status != Status::converged) continue;
      const double value = value_of(model, state, GetParam());
      smallest = std::min(smallest, value);
      largest = std::max(largest, value);
    }
  const double range = largest - smallest;
  EXPECT_LE(bounds.minimum.value, smallest + 1e-3 * range);
  EXPECT_GE(bounds.maximum.value, largest - 1e-3 * range);
  EXPECT_GE(bounds.minimum.value, smallest - 0.1 * range);
  EXPECT_LE(bounds.maximum.value, largest + 0.1 * range);
}

TEST_P(OneQuantity, OfRandomTractionsLiesInsideTheBounds) {
  const reduction::ReducedModel model = elastic(10, 7, 2);
  const auto reduced = condensed(model);
  const tractions::TractionBounds bounds = tractions::traction_bounds({reduced, {}, kOptions}, kOmega, GetParam());
  ASSERT_EQ(bounds.status, Status::converged) << bounds.reason;
  EXPECT_GE(bounds.stuck_nodes, 5);
  // What is attained is attained again from the origin reported.
  for (const tractions::AttainedValue* end : {&bounds.minimum, &bounds.maximum}) {
    const steady::State again = paths::steady_state({reduced, {.slip_origin = end->slip_origin}, kOptions}, kOmega);
    EXPECT_NEAR(value_of(model, again, GetParam()), end->value, 1e-6 * std::abs(end->value));
    EXPECT_LE(end->traction.cwiseAbs().maxCoeff(), 1 + 1e-9);
  }
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(-0.6, 0.6);
  double smallest = 1e300, largest = -1e300;
  int converged = 0;
  for (int p = 0; p < 200; ++p) {
    Eigen::MatrixXd origin = Eigen::MatrixXd::Zero(10, 1);
    for (double& value : origin.reshaped()) value = uniform(random);
    const steady::State state = paths::steady_state({reduced, {.slip_origin = origin}, kOptions}, kOmega);
    if (state.status != Status::converged) continue;
    ++converged;
    const double value = value_of(model, state, GetParam());
    smallest = std::min(smallest, value);
    largest = std::max(largest, value);
    EXPECT_GE(value, bounds.minimum.value - 1e-9);
    EXPECT_LE(value, bounds.maximum.value + 1e-9);
  }
  EXPECT_GT(converged, 190);
}

INSTANTIATE_TEST_SUITE_P(Quantities, OneQuantity,
                         testing::Values(tractions::BoundedQuantity::amplitude,
                                         tractions::BoundedQuantity::friction_energy,
                                         tractions::BoundedQuantity::wear_rate),
                         [](const testing::TestParamInfo<tractions::BoundedQuantity>& instance) {
                           return std::string(to_string(instance.param));
                         });

// With normal forces that tangential ones do not change, residual tractions shift the means and nothing else.
TEST(TractionBounds, CloseWhereNormalForcesDoNotFollow) {
  const reduction::ReducedModel model = rod(10);
  for (const tractions::BoundedQuantity quantity :
       {tractions::BoundedQuantity::amplitude, tractions::BoundedQuantity::friction_energy}) {
    const tractions::TractionBounds bounds =
        tractions::traction_bounds({condensed(model), {}, kOptions}, 2.5, quantity);
    ASSERT_EQ(bounds.status, Status::converged) << bounds.reason;
    ASSERT_GT(bounds.stuck_nodes, 0);
    EXPECT_NEAR(bounds.minimum.value, bounds.maximum.value, 1e-8 * bounds.nominal.value);
  }
}

TEST(TractionBounds, SayWhenThereIsNoFamily) {
  reduction::ReducedModel model = rod(3);
  model.contact.friction.setZero();
  const tractions::TractionBounds bounds =
      tractions::traction_bounds({condensed(model), {}, kOptions}, 2.5, tractions::BoundedQuantity::amplitude);
  EXPECT_EQ(bounds.status, Status::converged);
  EXPECT_EQ(bounds.stuck_nodes, 0);
  EXPECT_EQ(bounds.solves, 1);
  EXPECT_EQ(bounds.minimum.value, bounds.maximum.value);
  EXPECT_FALSE(bounds.reason.empty());
  EXPECT_THROW((void)tractions::traction_bounds({condensed(model), {}, kOptions}, 2.5,
                                                tractions::BoundedQuantity::amplitude, {.output = 1}),
               InputError);
}

}  // namespace
}  // namespace dovetail::verification
