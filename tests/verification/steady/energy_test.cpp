#include <gtest/gtest.h>

#include <algorithm>

#include "paths/steady_state.hpp"
#include "tests/verification/steady/rod.hpp"

namespace dovetail::verification {
namespace {

using steady::State;

struct Case {
  const char* name;
  reduction::ReducedModel model;
  double omega;
};

std::vector<Case> cases() {
  reduction::ReducedModel lifting = single_node();
  lifting.static_force(2) = -1;
  lifting.cosine_force(0, 2) = 2.4;
  return {{"slip along a line", rod(10), 2.5}, {"slip in a plane", single_node(), 1.1}, {"lift-off", lifting, 1.1}};
}

// Input less damping is the contact work harmonic by harmonic: U^T f, which a solve to rounding makes rounding.
TEST(Energy, BalancesToRounding) {
  for (const Case& at : cases())
    for (const int harmonics : {1, 7, 31}) {
      const steady::State state = paths::steady_state(
          {condensed(at.model), {}, {.harmonics = harmonics, .samples = 512, .tolerance = 1e-13}}, at.omega);
      ASSERT_EQ(state.status, Status::converged) << at.name;
      EXPECT_NEAR(state.input_energy, state.damping_energy + state.contact_work, 2e-13 * state.input_energy)
          << at.name << " " << harmonics;
    }
}

// Harmonics beyond H have X_h = -lambda_h / eps and take no work, so at any H the energy from increments of slip tends
// to the contact work as samples grow. By 1/N^2 and without a steady sign: a reversal falls anywhere between samples.
// Largest errors times N^2 measured over N = 128 ... 8192: 1.1 in a line, 3 in a plane, 60 with lift-off.
TEST(Energy, OfSlipConvergesToTheContactWork) {
  const double bounds[] = {4, 12, 200};
  int at_case = 0;
  for (const Case& at : cases()) {
    for (const int harmonics : {3, 15}) {
      const auto model = condensed(at.model);
      Eigen::MatrixXd guess;
      for (const int samples : {256, 1024, 4096}) {
        const steady::State state = paths::steady_state(
            {model, {}, {.harmonics = harmonics, .samples = samples, .slip_return = contact::SlipReturn::second_order}},
            at.omega, guess);
        ASSERT_EQ(state.status, Status::converged) << at.name;
        guess = state.displacement;
        const double error = std::abs(state.friction_energy / state.contact_work - 1);
        EXPECT_LT(error, bounds[at_case] / (static_cast<double>(samples) * samples)) << at.name << " " << samples;
      }
    }
    ++at_case;
  }
}

// The known friction energy, by the samples (at H = 31) and by the harmonics (at N = 4096).
TEST(Energy, OfTheSingleNodeConvergesWithHarmonics) {
  const double exact = 11.4313802832;
  const auto model = condensed(single_node());
  double before = 1;
  for (const int harmonics : {3, 7, 15, 31, 63}) {
    const steady::State state = paths::steady_state(
        {model, {}, {.harmonics = harmonics, .samples = 4096, .slip_return = contact::SlipReturn::second_order}}, 1.1);
    ASSERT_EQ(state.status, Status::converged);
    const double error = std::abs(state.contact_work / exact - 1);
    // Measured slopes of log error over log H: 2.0 to 2.7.
    EXPECT_LT(error, before / 2.5) << harmonics;
    before = error;
  }
  EXPECT_LT(before, 5e-6);
}

}  // namespace
}  // namespace dovetail::verification
