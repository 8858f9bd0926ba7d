#include "wear/asymptote/gross_sliding.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "paths/steady_state.hpp"
#include "scenes.hpp"
#include "wear/asymptote/asymptote.hpp"
#include "wear/params.hpp"

// A punch that nothing holds but its contact, rubbed by a share s of what friction can take: the middle part
// sqrt(1 - s) of its width sticks and ends up with the whole load.

namespace dovetail::wear {
namespace {

using Model = std::shared_ptr<const dynamics::CondensedModel>;

const steady::Options kSteady{.harmonics = 3, .samples = 64};

Model punch(double share, int nodes = 81) {
  scenes::Punch data;
  data.nodes = nodes;
  data.tangential_load = share * data.friction * data.normal_load;
  return std::make_shared<const dynamics::CondensedModel>(scenes::punch(data));
}

AsymptoteOptions settings(Arbitration arbitration) {
  AsymptoteOptions options;
  options.rate_threshold = 0.0;
  options.arbitration = arbitration;
  return options;
}

// The more of its friction is used, the less bears and the further the punch comes down on it.
TEST(GrossSliding, IsMeasuredByWhatBearsAndHowFarItCloses) {
  Bearing before{.needed = true, .share = 1.0, .closing = 0.0};
  for (const double used : {0.2, 0.5, 0.8}) {
    const Asymptote worn = asymptote({punch(used), {}, kSteady}, 1.0, settings(Arbitration::unsettled));
    ASSERT_EQ(worn.verdict, Verdict::asymptote) << used << ": " << dovetail::to_string(worn.status);
    EXPECT_EQ(worn.decided_by, FoundBy::release) << used;
    EXPECT_TRUE(worn.bearing.needed);
    EXPECT_FALSE(worn.bearing.doubtful()) << used;
    EXPECT_LT(worn.bearing.share, before.share) << used;
    EXPECT_GT(worn.bearing.closing, before.closing) << used;
    before = worn.bearing;
  }
}

TEST(GrossSliding, DoesNotDependOnTheMesh) {
  const auto compression = [](int nodes) {
    const Model model = punch(0.36, nodes);
    const steady::State state = paths::steady_state({model, {}, kSteady}, 1.0);
    EXPECT_EQ(state.status, Status::converged);
    return flank_compression(*model, state);
  };
  // A node's own flexibility grows with the logarithm of the mesh: by ln 2 / ln(20 L / h), about an eighth.
  EXPECT_NEAR(compression(81) / compression(41), 1.0, 0.2);
}

TEST(GrossSliding, IsNotJudgedWhereSpringsHold) {
  // Wear takes all the load away, and the oscillator goes on without.
  const Model model = std::make_shared<const dynamics::CondensedModel>(scenes::rubbing_oscillator(0.1, 2.0, 1.0, 0.05));
  const Asymptote worn = asymptote({model, {}, kSteady}, 1.0, settings(Arbitration::never));
  EXPECT_EQ(worn.verdict, Verdict::asymptote) << dovetail::to_string(worn.status);
  EXPECT_FALSE(worn.bearing.needed);
}

// sqrt(1 - 0.94) = 0.25 of the width sticks: only a history may confirm that, and does. It wears what sticks at first,
// too, when more of its friction is used, and slides for ever.
TEST(GrossSliding, NeedsTheHistorysWord) {
  for (const double used : {0.94, 0.97}) {
    const Asymptote alone = asymptote({punch(used), {}, kSteady}, 1.0, settings(Arbitration::never));
    EXPECT_LT(alone.bearing.share, 0.25);
    EXPECT_EQ(alone.verdict, Verdict::not_converged);
    EXPECT_EQ(alone.status, Status::gross_sliding) << used << ": " << dovetail::to_string(alone.status);
    const Asymptote judged = asymptote({punch(used), {}, kSteady}, 1.0, settings(Arbitration::unsettled));
    EXPECT_EQ(judged.doubt, Doubt::gross_sliding);
    EXPECT_TRUE(judged.confirmed_by_history);
    EXPECT_EQ(judged.status, Status::converged);
    EXPECT_EQ(judged.verdict, used < 0.95 ? Verdict::asymptote : Verdict::no_asymptote) << used;
  }
}

TEST(GrossSliding, IsNoStateBeyondWhatFlanksCanClose) {
  Bearing left{.needed = true, .share = 1.0, .closing = 1.01 * BearingParams{}.too_deep};
  EXPECT_TRUE(left.impossible());
  left.needed = false;
  EXPECT_FALSE(left.impossible());
  EXPECT_FALSE(left.doubtful());
}

}  // namespace
}  // namespace dovetail::wear
