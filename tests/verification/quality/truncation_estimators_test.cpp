// What the truncation estimators of the paper see and what they do not, and what the pseudo-penalty leaves in results.
#include <gtest/gtest.h>

#include <cmath>

#include "paths/steady_state.hpp"
#include "quality/error_bars.hpp"
#include "quality/penalty_sensitivity.hpp"
#include "tests/verification/steady/fine_reference.hpp"
#include "tests/verification/steady/random_contact.hpp"

namespace dovetail::verification {
namespace {

using steady::Options;
using steady::State;

TEST(PenaltySensitivity, VanishesWithMoreHarmonics) {
  const auto model = condensed(rod(10));
  double before = kInfinity, spread_before = kInfinity;
  for (const int harmonics : {3, 7, 15}) {
    const steady::Options options{.harmonics = harmonics, .samples = 1024};
    const steady::State state = paths::steady_state({model, {}, options}, 2.5);
    const quality::PenaltySensitivity found = quality::penalty_sensitivity({model, {}, options}, state);
    ASSERT_EQ(found.status, Status::converged);
    ASSERT_EQ(found.values.size(), 4u);
    // Ratio 1 is the state itself, to the tolerance of the solution.
    EXPECT_NEAR(found.values[1].friction_energy, state.friction_energy, 1e-7 * state.friction_energy);
    // The difference over (0.5, 2) is the slope over 2 ln 2 to first order; curvature leaves a factor of two.
    const double spread = std::abs(std::log(found.values[2].friction_energy / found.values[0].friction_energy));
    EXPECT_NEAR(spread, 2 * std::log(2.0) * std::abs(found.slope.friction_energy), 0.5 * spread);
    // Twice the harmonics: a half at least for order 1.
    EXPECT_LT(std::abs(found.slope.friction_energy), before / 2);
    EXPECT_LT(spread, spread_before / 2);
    before = std::abs(found.slope.friction_energy);
    spread_before = spread;
  }
}

// e_lambda sees what the series leaves out of the forces, e_E of their power - not the error of the results.
TEST(TruncationEstimators, FallWhileTheTrueErrorGrows) {
  const auto model = condensed(single_node());
  steady::Options options{.samples = 1024, .penalty_cascade = false, .slip_return = contact::SlipReturn::second_order};
  const double exact = 11.4313802832;  // energy per cycle, known to 2e-8
  const auto at = [&](double penalty_scale) {
    options.penalty_scale = penalty_scale;
    steady::State state = paths::steady_state({model, {}, options}, 1.1);
    EXPECT_EQ(state.status, Status::converged);
    return state;
  };
  const auto error = [&](const steady::State& state) { return std::abs(state.friction_energy / exact - 1); };
  const steady::State local = at(1), soft = at(0.1), stiff = at(4);
  // A softer penalty: e_lambda falls by 2.6, the true error grows by 8. A stiffer one: e_E falls, the error grows by 3.
  EXPECT_LT(soft.error_force, local.error_force / 2);
  EXPECT_GT(error(soft), 4 * error(local));
  EXPECT_LT(stiff.error_energy, local.error_energy);
  EXPECT_GT(error(stiff), 2 * error(local));
  // They overestimate at the local stiffness: e_E 80 times, e_lambda 30 times the error of the energy.
  EXPECT_GT(local.error_energy, 30 * error(local));
  EXPECT_GT(local.error_force, 10 * error(local));
  // They do not see the samples: with 15 harmonics the error of 32 first-order ones exceeds that of the series 5 times.
  options.harmonics = 15;
  const steady::State many = at(1);
  options.samples = 32;
  options.slip_return = contact::SlipReturn::first_order;
  const steady::State few = at(1);
  EXPECT_GT(error(few), 5 * error(many));
  EXPECT_LT(few.error_force, 1.2 * many.error_force);
}

// Where the normal preload is large e_lambda is even smaller than the error: it is relative to the whole force.
TEST(TruncationEstimators, AreNoErrorBar) {
  const auto model = condensed(rod(10));
  const steady::State state = paths::steady_state({model, {}, {}}, 2.5);
  const steady::State fine = fine_reference(model, state, 31, 2048);
  const double error = std::abs(state.amplitudes(0) / fine.amplitudes(0) - 1);
  EXPECT_GT(error, 3 * state.error_force);
  const quality::ErrorBars bars = quality::error_bars({model, {}, {}}, state);
  EXPECT_LE(error * fine.amplitudes(0), bars.total.amplitudes(0));
}

}  // namespace
}  // namespace dovetail::verification
