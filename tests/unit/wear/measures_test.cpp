#include "wear/measures.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "wear/asymptote/asymptote.hpp"
#include "wear/history/history.hpp"
#include "wear/history/integrator.hpp"

namespace dovetail::wear {
namespace {

using Eigen::VectorXd;

TEST(CycleJump, WearsTheFastestNodeByTheIncrement) {
  VectorXd rate(3);
  rate << 1e-12, 4e-12, 0.0;
  EXPECT_DOUBLE_EQ(cycle_jump(rate, 1e-7), 1e-7 / 4e-12);
  EXPECT_TRUE(std::isinf(cycle_jump(VectorXd::Zero(3), 1e-7)));
}

TEST(WornVolume, WeighsDepthsByArea) {
  reduction::ContactNodes contact;
  contact.area.resize(2);
  contact.area << 2.0, 3.0;
  VectorXd depth(2);
  depth << 0.5, 0.1;
  EXPECT_DOUBLE_EQ(worn_volume(contact, depth), 1.3);
  EXPECT_EQ(worn_volume(contact, {}), 0.0);
}

TEST(WearOptions, DefaultsAreAllowed) {
  EXPECT_TRUE(violations(HistoryOptions{}).empty());
  EXPECT_TRUE(violations(HistoryOptions::implicit()).empty());
  EXPECT_TRUE(violations(AsymptoteOptions{}).empty());
}

TEST(WearOptions, NameWhatIsWrong) {
  const auto found = violations(HistoryOptions{.increment = 0.0, .steps = 0}, "wear");
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].key, "wear.increment_um");
}

// Steps that erred are cut, steps that did not may grow, and a leap is longer than the step that gave up.
TEST(WearParams, KeepTheirOrder) {
  constexpr ExplicitParams jumps;
  EXPECT_LT(jumps.shortest_cut, jumps.longest_cut);
  EXPECT_LT(jumps.longest_cut, 1.0);
  EXPECT_LT(jumps.slowest, 1.0);
  EXPECT_GT(jumps.fastest, 1.0);
  constexpr ImplicitParams steps;
  EXPECT_LT(steps.shortest_cut, steps.longest_cut);
  EXPECT_LT(steps.longest_cut, 1.0);
  EXPECT_LT(steps.unsolved_cut, 1.0);
  EXPECT_LT(steps.shrinking, 1.0);
  EXPECT_GT(steps.slow_growth, 1.0);
  EXPECT_GE(steps.growth, steps.slow_growth);
  EXPECT_GT(steps.leap, 1.0);
  EXPECT_LT(steps.leap * steps.smallest, steps.first_increment);
}

TEST(Doubt, HasAnEntryForEachKind) {
  for (int i = 0; i <= static_cast<int>(Doubt::unfinished); ++i) {
    const DoubtEntry& found = entry(static_cast<Doubt>(i));
    EXPECT_EQ(static_cast<int>(found.doubt), i);
    EXPECT_FALSE(found.meaning.empty());
    EXPECT_EQ(found.name.empty(), i == 0);
  }
  // Only the history can say where these end.
  for (const Doubt doubt :
       {Doubt::nothing_holds, Doubt::pass_failed, Doubt::certificate, Doubt::threshold, Doubt::gross_sliding})
    EXPECT_FALSE(entry(doubt).direct_stands) << to_string(doubt);
}

}  // namespace
}  // namespace dovetail::wear
