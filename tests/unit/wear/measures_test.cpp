#include "wear/measures.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "wear/asymptote.hpp"
#include "wear/history.hpp"

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
  EXPECT_TRUE(violations(AsymptoteOptions{}).empty());
}

TEST(WearOptions, NameWhatIsWrong) {
  const auto found = violations(HistoryOptions{.increment = 0.0, .steps = 0, .follow = "mode"}, "wear");
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].key, "wear.increment_um");
}

}  // namespace
}  // namespace dovetail::wear
