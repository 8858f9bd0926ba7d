#include "paths/steady_state.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "paths/frequency_response.hpp"
#include "tests/verification/steady/rod.hpp"

namespace dovetail::verification {
namespace {

using steady::Options;
using steady::State;

double harmonic_amplitude(const steady::State& state, Eigen::Index h) {
  return std::hypot(state.outputs(0, 2 * h - 1), state.outputs(0, 2 * h));
}

// Amplitudes of an independent implementation of the same discrete equations, 12 digits printed; the residual is
// 1e-9 of the excitation, in practice 1e-15.
TEST(Rod, MatchesAnIndependentImplementation) {
  const steady::State three = paths::steady_state({condensed(rod(10)), {}, {.harmonics = 3}}, 2.5);
  ASSERT_EQ(three.status, Status::converged);
  EXPECT_NEAR(harmonic_amplitude(three, 1), 0.180214843944, 1e-12);
  EXPECT_NEAR(harmonic_amplitude(three, 3), 0.00343507318754, 1e-14);
  const steady::State seven = paths::steady_state({condensed(rod(10)), {}, {.harmonics = 7}}, 2.5);
  ASSERT_EQ(seven.status, Status::converged);
  EXPECT_NEAR(harmonic_amplitude(seven, 1), 0.179869422188, 1e-12);
  EXPECT_NEAR(harmonic_amplitude(seven, 3), 0.00348405307794, 1e-14);
  const steady::State fine = paths::steady_state({condensed(rod(100)), {}, {.harmonics = 3}}, 2.5);
  ASSERT_EQ(fine.status, Status::converged);
  EXPECT_NEAR(harmonic_amplitude(fine, 1), 0.184913938551, 1e-12);
}

TEST(Rod, BalancesItsEnergies) {
  const auto model = condensed(rod(10));
  for (const int harmonics : {3, 7, 15}) {
    const steady::State state = paths::steady_state({model, {}, {.harmonics = harmonics, .samples = 1024}}, 2.5);
    ASSERT_EQ(state.status, Status::converged);
    // Harmonic by harmonic this is U^T f = 0 with the residual at rounding.
    EXPECT_NEAR(state.input_energy, state.damping_energy + state.contact_work, 1e-12 * state.input_energy);
    // Friction on increments of X against the truncated series: trapezoids of about 10 N^-2.
    EXPECT_NEAR(state.friction_energy, state.contact_work, 1e-5 * state.friction_energy);
  }
}

TEST(Rod, WearsByArchard) {
  const auto model = condensed(rod(10));
  const steady::State state = paths::steady_state({model, {}, {}}, 2.5);
  for (Eigen::Index i = 0; i < 10; ++i) {
    // Constant normal force 1 on unit area: depth per cycle is k_w times the path, energy mu N times it.
    const steady::NodeSummary& node = state.nodes[static_cast<std::size_t>(i)];
    EXPECT_NEAR(state.wear_rate(i), 1e-3 * node.slip_distance, 1e-15);
    EXPECT_NEAR(node.dissipated_energy, 0.1 * node.slip_distance, 1e-13);
    EXPECT_EQ(node.stuck, node.slip_distance == 0);
  }
}

TEST(State, IsTheLinearResponseWithoutFrictionOrGaps) {
  // mu = 0 and always closed: normal displacements are zero, tangential ones free.
  reduction::ReducedModel model = rod(6);
  model.contact.friction.setZero();
  const double omega = 2.2;
  const steady::State state = paths::steady_state({condensed(model), {}, {}}, omega);
  ASSERT_EQ(state.status, Status::converged);
  const Eigen::MatrixXcd dynamic = model.stiffness.cast<std::complex<double>>() +
                                   std::complex<double>(0, omega) * model.damping - omega * omega * model.mass;
  const Eigen::MatrixXcd free = dynamic.topLeftCorner(12, 12);
  const Eigen::VectorXcd force = model.cosine_force.row(0).head(12).transpose().cast<std::complex<double>>();
  const Eigen::VectorXcd exact = free.lu().solve(force);
  EXPECT_NEAR(state.outputs(0, 1), exact(5).real(), 1e-12);
  EXPECT_NEAR(state.outputs(0, 2), -exact(5).imag(), 1e-12);
  EXPECT_NEAR(state.amplitudes(0), std::abs(exact(5)), 1e-12);
  EXPECT_EQ(state.friction_energy, 0);
}

TEST(State, ReleasedNodesCarryNothing) {
  const reduction::ReducedModel model = rod(6);
  const steady::Condition all{.released = std::vector<char>(6, 1)};
  const steady::State free = paths::steady_state({condensed(model), all, {}}, 2.2);
  ASSERT_EQ(free.status, Status::converged);
  EXPECT_TRUE(free.force.isZero(0));
  // The same as a gap nobody crosses, and as no friction for the tip (normal directions are uncoupled).
  const steady::Condition far{.wear_depth = Eigen::VectorXd::Constant(6, 100.0)};
  const steady::State open = paths::steady_state({condensed(model), far, {}}, 2.2);
  ASSERT_EQ(open.status, Status::converged);
  EXPECT_NEAR(free.amplitudes(0), open.amplitudes(0), 1e-10);
  // u_N = f_N / K_N = 1 with nothing to stop it.
  EXPECT_NEAR(free.displacement(0, 0), 1, 1e-12);
  const steady::Condition one{.released = {1, 0, 0, 0, 0, 0}};
  const steady::State partly = paths::steady_state({condensed(model), one, {}}, 2.2);
  ASSERT_EQ(partly.status, Status::converged);
  EXPECT_TRUE(partly.force.row(0).isZero(0));
  EXPECT_TRUE(partly.force.row(1).isZero(0));
  EXPECT_GT(partly.force.row(3).norm(), 0.01);
}

TEST(State, KeepsTheHistoryOfStuckNodes) {
  reduction::ReducedModel model = rod(4);
  model.contact.friction.setConstant(50);
  model.contact.slip_origin.setConstant(0.02);
  const steady::State state = paths::steady_state({condensed(model), {}, {}}, 2.2);
  ASSERT_EQ(state.status, Status::converged);
  for (Eigen::Index i = 0; i < 4; ++i) {
    EXPECT_TRUE(state.nodes[static_cast<std::size_t>(i)].stuck);
    EXPECT_NEAR(state.displacement(2 * i + 1, 0), 0.02, 1e-14);
    EXPECT_NEAR(state.slip_end(i, 0), 0.02, 1e-14);
  }
}

TEST(FrequencyResponse, FollowsTheOrderAskedFor) {
  const auto model = condensed(rod(10));
  const std::vector<double> omega{3.4, 3.0, 2.6};
  const std::vector<steady::State> states = paths::frequency_response({model, {}, {}}, omega);
  ASSERT_EQ(states.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    ASSERT_EQ(states[i].status, Status::converged);
    EXPECT_EQ(states[i].omega, omega[i]);
    EXPECT_NEAR(states[i].amplitudes(0), paths::steady_state({model, {}, {}}, omega[i]).amplitudes(0), 1e-9);
  }
  const std::vector<steady::State> stopped =
      paths::frequency_response({model, {}, {}}, omega, [](std::size_t, const steady::State&) { return false; });
  EXPECT_EQ(stopped[0].status, Status::converged);
  EXPECT_EQ(stopped[2].status, Status::interrupted);
}

}  // namespace
}  // namespace dovetail::verification
