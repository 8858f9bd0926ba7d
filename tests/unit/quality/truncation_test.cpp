// The pieces error bars are made of, and the pseudo-penalty.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "contact/pseudo_penalty.hpp"
#include "paths/steady_state.hpp"
#include "quality/automatic.hpp"
#include "quality/penalty_sensitivity.hpp"
#include "quality/truncation.hpp"
#include "tests/verification/steady/random_contact.hpp"

namespace dovetail {
namespace {

// diag(Z_h) of a massless contact differs from its limit by terms of 1/(h w)^2 and damping of 1/(h w).
void expect_local_stiffness_is_the_limit(const reduction::ReducedModel& model) {
  const dynamics::CondensedModel condensed(model);
  const Eigen::MatrixXcd high = condensed.stiffness(1'000'000, 1.0, condensed.harmonic(1'000'000, 1.0));
  const double largest = condensed.local_stiffness().maxCoeff();
  for (Eigen::Index i = 0; i < condensed.contact_size(); ++i)
    EXPECT_NEAR(high(i, i).real(), condensed.local_stiffness()(i), 1e-5 * largest) << i;
}

TEST(SamplesFor, AreMoreThanFourForEachHarmonic) {
  EXPECT_EQ(quality::samples_for(11, 128), 128);
  EXPECT_EQ(quality::samples_for(51, 128), 256);
  EXPECT_EQ(quality::samples_for(32, 128), 256);  // 128 samples alias its 32nd harmonic with its 96th
  EXPECT_GT(quality::samples_for(25, 40), 100);
}

TEST(LocalStiffness, IsTheHighHarmonicLimitForMasslessContact) {
  for (unsigned seed = 0; seed < 10; ++seed)
    expect_local_stiffness_is_the_limit(verification::random_contact(seed).model);
  expect_local_stiffness_is_the_limit(verification::rod(5));
  expect_local_stiffness_is_the_limit(verification::single_node());
}

TEST(DynamicStiffness, HasTheInertiaOfHighHarmonics) {
  // Mass 1 on the contact itself, stiffness 1: Z_h = 1 - h^2, where h^2 is no int.
  const dynamics::CondensedModel condensed(verification::den_hartog(0.4));
  const Eigen::MatrixXd z = condensed.stiffness(1'000'000, 1.0, condensed.harmonic(1'000'000, 1.0)).real();
  EXPECT_NEAR(z.minCoeff(), 1 - 1e12, 1e-3);  // rounding of 1e12
}

TEST(LocalStiffness, FollowsInternalDofsWithoutMass) {
  // A second spring of 5 in series with a massless dof on a foundation of 0.5 behind T1: 2 + 5 * 0.5 / 5.5.
  const reduction::ReducedModel node = verification::single_node();
  reduction::ReducedModel model = verification::empty_model(7, 1, 2);
  model.mass.topLeftCorner<6, 6>() = node.mass;
  model.damping.topLeftCorner<6, 6>() = node.damping;
  model.stiffness.topLeftCorner<6, 6>() = node.stiffness;
  model.contact.tangential << 3, 4;
  model.contact.normal << 5;
  model.stiffness(3, 3) += 5;
  model.stiffness(6, 6) = 5.5;
  model.stiffness(3, 6) = model.stiffness(6, 3) = -5;
  ASSERT_FALSE(dynamics::CondensedModel(model).modal());
  EXPECT_NEAR(dynamics::CondensedModel(model).local_stiffness()(1), 2 + 5 * 0.5 / 5.5, 1e-12);
  expect_local_stiffness_is_the_limit(model);
  model.damping.setZero();
  ASSERT_TRUE(dynamics::CondensedModel(model).modal());
  expect_local_stiffness_is_the_limit(model);
}

TEST(LocalStiffness, IsStaticWhereContactHasMass) {
  // Z_h = 1 - (h w)^2 has no limit; the stiffness alone is used.
  const dynamics::CondensedModel model(verification::den_hartog(0.4));
  EXPECT_FALSE(model.massless_contact());
  EXPECT_EQ(model.local_stiffness()(1), 1);
  EXPECT_TRUE(dynamics::CondensedModel(verification::rod(3)).massless_contact());
}

TEST(PseudoPenalty, HasOneTangentialValuePerNode) {
  Eigen::VectorXd local(6);
  local << 5, 2, 4, 7, 0, 0;
  const contact::PseudoPenalty automatic = contact::pseudo_penalty(local, 3);
  EXPECT_EQ(automatic.normal(0), 5);
  EXPECT_EQ(automatic.tangential(0), 3);
  EXPECT_EQ(automatic.normal(1), 7);
  EXPECT_DOUBLE_EQ(automatic.tangential(1), 7e-3);  // nothing positive: a thousandth of the largest
  local.tail(2) << -3e6, -5e6;
  EXPECT_DOUBLE_EQ(contact::pseudo_penalty(local, 3).tangential(1), 4e3);  // mass: a thousandth of its resistance
  const contact::PseudoPenalty given = contact::pseudo_penalty(local, 3, 10, 20);
  EXPECT_EQ(given.normal(1), 10);
  EXPECT_EQ(given.tangential(0), 20);
}

TEST(Padding, KeepsOrCutsHarmonics) {
  const Eigen::MatrixXd coefficients = Eigen::MatrixXd::Random(4, 7);
  const Eigen::MatrixXd more = paths::padded(coefficients, 5);
  EXPECT_EQ(more.leftCols(7), coefficients);
  EXPECT_TRUE(more.rightCols(4).isZero(0));
  EXPECT_EQ(paths::padded(coefficients, 1), coefficients.leftCols(3));
}

TEST(Refinement, AddsSamplesBeforeHarmonicsAlias) {
  const steady::Options plenty = quality::more_harmonics({.harmonics = 3, .samples = 128});
  EXPECT_EQ(plenty.harmonics, 7);
  EXPECT_EQ(plenty.samples, 128);
  const steady::Options scarce = quality::more_harmonics({.harmonics = 31, .samples = 64});
  EXPECT_EQ(scarce.harmonics, 63);
  EXPECT_EQ(scarce.samples, 256);
}

TEST(Refinement, StartsFromTheStateAndKeepsItsPenalty) {
  const auto model = verification::condensed(verification::rod(4));
  steady::State state = paths::steady_state({model, {}, {}}, 2.5);
  ASSERT_EQ(state.status, Status::converged);
  const steady::State same = paths::refined_state({model, {}, {}}, state);
  EXPECT_LE(same.iterations, 1);
  state.penalty_ratio = 0.5;
  const steady::State softer = paths::refined_state({model, {}, {}}, state);
  EXPECT_EQ(softer.penalty_ratio, 0.5);
  EXPECT_DOUBLE_EQ(softer.penalty.tangential(0), 0.5 * same.penalty.tangential(0));
}

TEST(ErrorBars, AddUpTheirParts) {
  const quality::Quantities value = quality::constant_quantities(1, 100);
  const quality::TruncationChanges changes{.harmonics = quality::constant_quantities(1, 1),
                                           .samples = quality::constant_quantities(1, 0.1),
                                           .softer = quality::constant_quantities(1, 0.4),
                                           .stiffer = quality::constant_quantities(1, 0.8)};
  const quality::ErrorBars bars = quality::bars_from(value, changes, 1e-6, true);
  EXPECT_DOUBLE_EQ(bars.total.friction_energy, 2 * 1 + 3 * 0.1 + 0.25 * 0.8 + 1e-4);
  EXPECT_DOUBLE_EQ(bars.total.amplitudes(0), bars.total.wear_volume_rate);
  EXPECT_DOUBLE_EQ(quality::bars_from(value, changes, 1e-6, false).harmonics.friction_energy, 4);
}

TEST(ErrorBars, AreWithinTolerancesOfWhatMatters) {
  quality::ErrorBars bars{.status = Status::converged,
                          .value = quality::constant_quantities(2, 1),
                          .harmonics = quality::constant_quantities(2, 0),
                          .samples = quality::constant_quantities(2, 0),
                          .penalty = quality::constant_quantities(2, 0),
                          .total = quality::constant_quantities(2, 0)};
  steady::State state;
  state.input_energy = 1;
  EXPECT_TRUE(within(bars, state, {}));
  bars.total.amplitudes << 0.9e-3, 1.1e-3;
  EXPECT_FALSE(within(bars, state, {}));
  EXPECT_TRUE(within(bars, state, {.amplitude_tolerance = 2e-3}));
  // An output that hardly moves, and friction that hardly dissipates.
  bars.value.amplitudes << 1, 1e-12;
  bars.total.amplitudes << 0, 0.9e-9;
  EXPECT_TRUE(within(bars, state, {}));
  bars.value.friction_energy = 1e-9;
  bars.total.friction_energy = 0.9e-5;
  EXPECT_TRUE(within(bars, state, {}));
  bars.total.friction_energy = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(within(bars, state, {}));
  bars.total.friction_energy = 0;
  bars.status = Status::stalled;
  EXPECT_FALSE(within(bars, state, {}));
}

TEST(Truncation, RefusesOptionsOutOfRange) {
  const auto model = verification::condensed(verification::rod(2));
  const steady::State state = paths::steady_state({model, {}, {}}, 2.5);
  EXPECT_THROW(static_cast<void>(quality::automatic_state({model, {}, {}}, 2.5, {.amplitude_tolerance = 0})),
               InputError);
  EXPECT_THROW(static_cast<void>(quality::automatic_state({model, {}, {}}, 2.5, {.max_harmonics = 0})), InputError);
  EXPECT_THROW(static_cast<void>(quality::penalty_sensitivity({model, {}, {}}, state, {.ratios = {1, -1}})),
               InputError);
  EXPECT_THROW(static_cast<void>(quality::penalty_sensitivity({model, {}, {}}, state, {.step = 0})), InputError);
}

}  // namespace
}  // namespace dovetail
