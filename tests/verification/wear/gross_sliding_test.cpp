#include "wear/gross_sliding.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "scenes.hpp"
#include "wear/asymptote.hpp"

// A punch that nothing holds but its contact, rubbed by a share s of what friction can take: the middle part
// sqrt(1 - s) of its width sticks and ends up with the whole load.

namespace dovetail::wear {
namespace {

using Model = std::shared_ptr<const response::CondensedModel>;

const response::SteadyOptions kSteady{.harmonics = 3, .samples = 64};

Model punch(double share, int nodes = 81) {
  scenes::Punch data;
  data.nodes = nodes;
  data.tangential_load = share * data.friction * data.normal_load;
  return std::make_shared<const response::CondensedModel>(scenes::punch(data));
}

AsymptoteOptions settings(const char* arbitration) {
  AsymptoteOptions options;
  options.rate_threshold = 0.0;
  options.arbitration = arbitration;
  return options;
}

TEST(GrossSliding, IsMeasuredByWhatBearsAndHowFarItClosed) {
  // sqrt(1 - 0.36) = 0.8 of the width, to the two nodes that a zone of fifty ends between.
  const Asymptote worn = asymptote(punch(0.36), 1.0, {}, kSteady, settings("unsettled"));
  ASSERT_EQ(worn.verdict, Verdict::asymptote) << dovetail::to_string(worn.status);
  EXPECT_TRUE(worn.bearing.needed);
  EXPECT_NEAR(worn.bearing.share, 0.8, 0.05);
  EXPECT_GT(worn.bearing.closing, 0.0);
  EXPECT_FALSE(worn.bearing.doubtful());
  EXPECT_EQ(worn.decided_by, "release");
}

TEST(GrossSliding, DoesNotDependOnTheMesh) {
  const auto compression = [](int nodes) {
    const Model model = punch(0.36, nodes);
    const response::SteadyState state = response::steady_state(model, 1.0, {}, kSteady);
    EXPECT_EQ(state.status, Status::converged);
    return flank_compression(*model, state);
  };
  // A node's own flexibility grows with the logarithm of the mesh: by ln 2 / ln(20 L / h), about an eighth.
  EXPECT_NEAR(compression(81) / compression(41), 1.0, 0.2);
}

TEST(GrossSliding, IsNotJudgedWhereSpringsHold) {
  // Wear takes all the load away, and the oscillator goes on without.
  const Model model = std::make_shared<const response::CondensedModel>(scenes::rubbing_oscillator(0.1, 2.0, 1.0, 0.05));
  const Asymptote worn = asymptote(model, 1.0, {}, kSteady, settings("never"));
  EXPECT_EQ(worn.verdict, Verdict::asymptote) << dovetail::to_string(worn.status);
  EXPECT_FALSE(worn.bearing.needed);
}

// sqrt(1 - 0.99) = 0.1 of the width bears: only a history may confirm that.
TEST(GrossSliding, NeedsTheHistorysWord) {
  const Asymptote alone = asymptote(punch(0.99), 1.0, {}, kSteady, settings("never"));
  EXPECT_LT(alone.bearing.share, 0.25);
  EXPECT_EQ(alone.verdict, Verdict::not_converged);
  EXPECT_EQ(alone.status, Status::gross_sliding) << dovetail::to_string(alone.status);
  const Asymptote confirmed = asymptote(punch(0.99), 1.0, {}, kSteady, settings("unsettled"));
  EXPECT_EQ(confirmed.doubt, "gross_sliding");
  EXPECT_TRUE(confirmed.confirmed_by_history || confirmed.verdict == Verdict::not_converged);
}

TEST(GrossSliding, IsNoStateBeyondWhatFlanksCanClose) {
  Bearing left{.needed = true, .share = 1.0, .closing = 1.01 * Bearing::kTooDeep};
  EXPECT_TRUE(left.impossible());
  left.needed = false;
  EXPECT_FALSE(left.impossible());
  EXPECT_FALSE(left.doubtful());
}

}  // namespace
}  // namespace dovetail::wear
