#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "paths/steady_state.hpp"
#include "verdict_labels.hpp"
#include "wear/asymptote/asymptote.hpp"

// What becomes of the wear in labelled scenes: verdict_labels.inc, as printed by the program label_verdicts from
// explicit histories at finer settings. Members that these leave open are commented out.

namespace dovetail::wear {
namespace {

using scenes::Family;
using scenes::Label;

struct Labelled {
  Family family;
  unsigned number;
  Label label;
};

constexpr Labelled kScenes[] = {
#include "verdict_labels.inc"
};

const steady::Options& kSteady = scenes::kVerdictSettings;

std::shared_ptr<const dynamics::CondensedModel> condensed(Family family, unsigned number) {
  return std::make_shared<const dynamics::CondensedModel>(scenes::verdict_model(family, number));
}

AsymptoteOptions settings(Arbitration arbitration) {
  AsymptoteOptions options;
  options.rate_threshold = 0.0;
  options.arbitration = arbitration;
  return options;
}

class Verdicts : public testing::TestWithParam<Labelled> {};

TEST_P(Verdicts, AreThoseOfTheHistory) {
  const auto [family, number, label] = GetParam();
  const Asymptote worn = asymptote({condensed(family, number), {}, kSteady}, 1.0, settings(Arbitration::automatic));
  RecordProperty("doubt", std::string(to_string(worn.doubt)));
  RecordProperty("jacobians", worn.jacobians);
  EXPECT_EQ(worn.status, Status::converged) << dovetail::to_string(worn.status);
  const bool elsewhere = std::any_of(worn.other_states.begin(), worn.other_states.end(),
                                     [](const OtherState& state) { return state.found_by == FoundBy::release; });
  if (label == Label::goes_on) {
    EXPECT_EQ(worn.verdict, Verdict::no_asymptote) << to_string(worn.doubt);
    EXPECT_TRUE(worn.confirmed_by_history);
    EXPECT_GT(worn.rate.maxCoeff(), 0.0);
    return;
  }
  EXPECT_EQ(worn.verdict, Verdict::asymptote) << to_string(worn.doubt);
  EXPECT_EQ(elsewhere, label == Label::elsewhere)
      << to_string(worn.doubt) << ", decided by " << to_string(worn.decided_by);
  EXPECT_LT(worn.certificate, 1e-2);
}
INSTANTIATE_TEST_SUITE_P(Labelled, Verdicts, testing::ValuesIn(kScenes), [](const auto& scene) {
  return std::string(scenes::to_string(scene.param.family)) + "_" + std::to_string(scene.param.number);
});

// Labelled by construction: loaded far below friction without a crown nothing slips.
TEST(Verdict, IsTrivialWherePressedBlocksStick) {
  for (unsigned number = 0; number < 8; ++number) {
    const Asymptote worn =
        asymptote({condensed(Family::pressed, number), {}, kSteady}, 1.0, settings(Arbitration::automatic));
    EXPECT_EQ(worn.verdict, Verdict::asymptote) << number;
    EXPECT_EQ(worn.worn_volume, 0.0) << number;
    EXPECT_EQ(worn.doubt, Doubt::none) << number;
  }
}

// By construction: a rubbing node that wear unloads ends free of load, W = N_0 / k_n; one under a dead load does not.
TEST(Verdict, OfAnOscillatorFollowsFromItsNormalSpring) {
  for (const double load : {0.05, 0.1, 0.2})
    for (const double omega : {0.8, 1.0, 1.3}) {
      const auto model =
          std::make_shared<const dynamics::CondensedModel>(scenes::rubbing_oscillator(load, 2.0, 1.0, 0.05));
      const steady::State unworn = paths::steady_state({model, {}, kSteady}, omega);
      ASSERT_EQ(unworn.status, Status::converged);
      if (unworn.wear_rate[0] == 0.0) continue;
      const Asymptote worn = asymptote({model, {}, kSteady}, omega, settings(Arbitration::always));
      EXPECT_EQ(worn.verdict, Verdict::asymptote) << load << " " << omega << " " << to_string(worn.doubt);
      EXPECT_TRUE(worn.confirmed_by_history);
      // Worn until it sticks or carries nothing, whichever comes first; sliding gets easier as the load falls.
      EXPECT_NEAR(worn.depth[0], load / 2.0, 1e-2 * load / 2.0) << load << " " << omega;
    }
}

}  // namespace
}  // namespace dovetail::wear
