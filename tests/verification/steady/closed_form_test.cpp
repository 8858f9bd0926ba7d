#include <gtest/gtest.h>

#include "paths/steady_state.hpp"
#include "tests/verification/steady/rod.hpp"

namespace dovetail::verification {
namespace {

using steady::State;

// Friction energy 11.4313802832 (2e-8) of the independent time integration. The node lifts off and slips in space, so
// the series converges algebraically.
TEST(SingleNode, ApproachesTheKnownFrictionEnergy) {
  const double exact = 11.4313802832;
  const auto model = condensed(single_node());
  // Measured: 2.3e-3, 4.3e-4, 6.6e-5, 1e-5; bounds leave half as much again.
  const double bounds[] = {3.5e-3, 6.5e-4, 1e-4, 1.7e-5};
  const int harmonics[] = {3, 7, 15, 31};
  for (int i = 0; i < 4; ++i) {
    const steady::State state = paths::steady_state(
        {model, {}, {.harmonics = harmonics[i], .samples = 4096, .slip_return = contact::SlipReturn::second_order}},
        1.1);
    ASSERT_EQ(state.status, Status::converged);
    EXPECT_LT(std::abs(state.friction_energy / exact - 1), bounds[i]) << harmonics[i];
    EXPECT_NEAR(state.input_energy, state.damping_energy + state.contact_work, 1e-9 * state.input_energy);
  }
}

struct Oscillation {
  double frequency, amplitude;
};

// V = 1 / (1 - b^2), U = tan(pi / 2b) / b, x_0 = sqrt(V^2 - x_f^2 U^2). With mass on the contact the force jumps, and a
// truncated series errs by O(1/H): 1.5 / H covers the three cases, halving from H = 7 to 15.
TEST(DenHartog, ConvergesAtFirstOrderInTheHarmonics) {
  for (const Oscillation& known : {Oscillation{0.8, 2.501787881002}, {1.2, 1.902028159492}, {2.0, 0.266666666667}}) {
    double error[2] = {0, 0};
    for (int i = 0; i < 2; ++i) {
      const int harmonics = i == 0 ? 7 : 15;
      const steady::State state = paths::steady_state(
          {condensed(den_hartog(0.4)), {}, {.harmonics = harmonics, .samples = 1024}}, known.frequency);
      ASSERT_EQ(state.status, Status::converged) << known.frequency << " " << harmonics;
      error[i] = std::abs(state.amplitudes(0) / known.amplitude - 1);
      EXPECT_LT(error[i], 1.5 / harmonics);
    }
    EXPECT_NEAR(error[0] / error[1], 15.0 / 7, 0.4) << known.frequency;
  }
}

// The same with a massless contact node behind a spring k_c: rigid friction is the limit of stiff springs, with an
// error of the order x_f / k_c, and the series converges.
TEST(DenHartog, IsTheLimitOfAStiffContactSpring) {
  for (const Oscillation& known : {Oscillation{0.8, 2.501787881002}, {1.2, 1.902028159492}}) {
    double before = 1;
    for (const double spring : {20.0, 80.0}) {
      reduction::ReducedModel model = empty_model(3, 1, 1);
      model.mass(0, 0) = 1;
      model.stiffness << 1 + spring, -spring, 0, -spring, spring, 0, 0, 0, 1;
      model.contact.tangential << 1;
      model.contact.normal << 2;
      model.contact.friction << 0.4;
      model.static_force(2) = 1;
      model.cosine_force(0, 0) = 1;
      model.output_vectors = Eigen::MatrixXd::Identity(1, 3);
      model.output_names = {"x"};
      const steady::State state =
          paths::steady_state({condensed(model), {}, {.harmonics = 25, .samples = 1024}}, known.frequency);
      ASSERT_EQ(state.status, Status::converged) << known.frequency;
      const double error = std::abs(state.amplitudes(0) / known.amplitude - 1);
      EXPECT_LT(error, 1.5 / spring + 1.0 / 25);
      EXPECT_LT(error, before);
      before = error;
    }
  }
}

}  // namespace
}  // namespace dovetail::verification
