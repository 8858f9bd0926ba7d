#include "wear/asymptote/drift.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "scenes.hpp"
#include "wear/asymptote/asymptote.hpp"
#include "wear/history/history.hpp"

// A node that wears until it is free: the limit is the oscillator without it, W = N_0 / k_n.

namespace dovetail::wear {
namespace {

constexpr double kLoad = 0.5;
constexpr double kNormal = 2.0;
constexpr double kTangential = 0.3;
constexpr double kDamping = 0.1;
const steady::Options kDrifting{.harmonics = 5, .samples = 128};
const paths::ResonanceOptions kResonance{};

std::shared_ptr<const dynamics::CondensedModel> oscillator() {
  return std::make_shared<const dynamics::CondensedModel>(
      scenes::rubbing_oscillator(kLoad, kNormal, kTangential, kDamping));
}

TEST(Drift, EndsAtTheFreeOscillator) {
  const steady::Joint joint{oscillator(), {}, kDrifting};
  const paths::Resonance unworn = paths::resonance(joint, 1.05, kResonance);
  ASSERT_EQ(unworn.status, Status::converged);
  const Asymptote worn = asymptote(joint, unworn.omega, {.rate_threshold = 0.0}, &unworn.state);
  ASSERT_EQ(worn.verdict, Verdict::asymptote) << to_string(worn.status);
  EXPECT_NEAR(worn.largest_depth, kLoad / kNormal, 1e-9);  // residual 1e-9 of a force 0.1, over k_n = 2
  EXPECT_FALSE(worn.confirmed_by_history);

  const Drift drift = resonance_drift(joint.worn(worn.depth), unworn, kResonance);
  ASSERT_EQ(drift.worn.status, Status::converged);
  // Peak of the displacement of a damped oscillator, w^2 = 1 - c^2 / 2; found to 1e-7.
  EXPECT_NEAR(drift.worn.omega, std::sqrt(1.0 - 0.5 * kDamping * kDamping), 1e-6);
  EXPECT_NEAR(drift.drift, drift.worn.omega / unworn.omega - 1.0, 1e-15);
  EXPECT_LT(drift.drift, -1e-3);
}

TEST(Drift, IsFollowedByTheHistory) {
  const steady::Joint joint{oscillator(), {}, kDrifting};
  const paths::Resonance unworn = paths::resonance(joint, 1.05, kResonance);
  ASSERT_EQ(unworn.status, Status::converged);
  const HistoryOptions options{
      .increment = 0.01, .steps = 100, .rate_fraction = 1e-3, .rate_threshold = 0.0, .follow = Follow::resonance};
  const History run = history(joint, {.omega = unworn.omega, .resonance = kResonance}, options);
  EXPECT_EQ(run.status, Status::converged);
  EXPECT_EQ(run.end, HistoryEnd::worn_out);
  const Eigen::Index last = run.cycles.size() - 1;
  EXPECT_NEAR(run.frequency[0], unworn.omega, 1e-5);
  // Depth and frequency of the free oscillator, less or more than one increment (2 % of the drift each).
  EXPECT_NEAR(run.depth(last, 0), kLoad / kNormal, options.increment);
  EXPECT_NEAR(run.frequency[last], std::sqrt(1.0 - 0.5 * kDamping * kDamping), 0.1 * std::abs(run.frequency[0] - 1.0));
}

}  // namespace
}  // namespace dovetail::wear
