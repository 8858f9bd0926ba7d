#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "scenes.hpp"
#include "wear/asymptote/asymptote.hpp"
#include "wear/history/history.hpp"

namespace dovetail::wear {
namespace {

const steady::Options kBlock{.harmonics = 3, .samples = 64};
const AsymptoteOptions kEveryRate{.rate_threshold = 0.0};

std::shared_ptr<const dynamics::CondensedModel> condensed(const scenes::Block& data) {
  return std::make_shared<const dynamics::CondensedModel>(scenes::block(data));
}

class RandomBlock : public testing::TestWithParam<unsigned> {};

// Ever finer histories converge to the direct answer, first order in the largest increment.
TEST_P(RandomBlock, HistoriesConvergeToTheAsymptote) {
  const auto model = condensed(scenes::random_block(GetParam()));
  const Asymptote worn = asymptote({model, {}, kBlock}, 1.0, kEveryRate);
  ASSERT_EQ(worn.verdict, Verdict::asymptote) << to_string(worn.status);
  ASSERT_GT(worn.largest_depth, 0.0);
  RecordProperty("released", static_cast<int>(std::count(worn.released.begin(), worn.released.end(), true)));
  RecordProperty("passes", worn.passes);
  RecordProperty("jacobians", worn.jacobians);
  RecordProperty("certificate", testing::PrintToString(worn.certificate));
  EXPECT_LT(worn.certificate, 1e-6);
  double error = 0.0;
  for (double fraction : {0.1, 0.02, 0.005}) {
    const History run = history(
        {model, {}, kBlock}, {.omega = 1.0},
        {.increment = fraction * worn.largest_depth, .steps = 3000, .rate_fraction = 1e-4, .rate_threshold = 0.0});
    EXPECT_EQ(run.end, HistoryEnd::worn_out) << to_string(run.end) << " " << to_string(run.status);
    const Eigen::VectorXd depth = run.depth.bottomRows(1).transpose();
    error = (depth - worn.depth).cwiseAbs().maxCoeff() / worn.largest_depth;
    RecordProperty("error_" + std::to_string(fraction), std::to_string(error));
    RecordProperty("jacobians_" + std::to_string(fraction), run.jacobians);
    // First order: a node overshoots by at most about one increment; what remains at the end is the wear still to come
    // where nodes touch only at times, which dies out slowly.
    EXPECT_LT(error, fraction + 0.01) << fraction;
  }
}
INSTANTIATE_TEST_SUITE_P(Six, RandomBlock, testing::Values(1u, 2u, 3u, 4u, 5u, 7u));

// Zero-rate states are not unique: in members 0 and 6 of the family the pressures shift while it wears, nodes wear that
// the limit would not have needed, and histories converge to a deeper state than the direct answer. Both are at rest.
TEST(Block, HistoryCanEndDeeperThanTheAsymptote) {
  const auto model = condensed(scenes::random_block(0));
  AsymptoteOptions unasked = kEveryRate;
  unasked.arbitration = Arbitration::never;
  const Asymptote worn = asymptote({model, {}, kBlock}, 1.0, unasked);
  ASSERT_EQ(worn.verdict, Verdict::asymptote);
  EXPECT_EQ(worn.doubt, Doubt::reload);
  EXPECT_LT(worn.certificate, 1e-6);
  std::vector<double> volumes;
  for (double fraction : {0.08, 0.04, 0.02}) {
    const History run = history(
        {model, {}, kBlock}, {.omega = 1.0},
        {.increment = fraction * worn.largest_depth, .steps = 3000, .rate_fraction = 1e-4, .rate_threshold = 0.0});
    ASSERT_EQ(run.end, HistoryEnd::worn_out);
    volumes.push_back(run.worn_volume[run.worn_volume.size() - 1] / worn.worn_volume);
  }
  // Differences of successive halvings shrink, and their limit stays more than a tenth above the direct answer.
  EXPECT_LT(std::abs(volumes[2] - volumes[1]), std::abs(volumes[1] - volumes[0]));
  EXPECT_GT(2.0 * volumes[2] - volumes[1], 1.1);
}

/// A flat block, pressed enough to stick everywhere.
scenes::Block stuck_block() {
  return {.height = 0.35, .friction = 0.5, .tangential_load = 0.1 * 0.5e-3, .couple = 1.0, .coupling = 0.0};
}

TEST(Block, WithoutSlipDoesNotWear) {
  const Asymptote worn = asymptote({condensed(stuck_block()), {}, kBlock}, 1.0, kEveryRate);
  EXPECT_EQ(worn.verdict, Verdict::asymptote);
  EXPECT_EQ(worn.depth.maxCoeff(), 0.0);
  EXPECT_EQ(worn.unworn_rate.maxCoeff(), 0.0);
  EXPECT_EQ(worn.passes, 0);
  const History run = history({condensed(stuck_block()), {}, kBlock}, {.omega = 1.0}, {.rate_threshold = 0.0});
  EXPECT_EQ(run.end, HistoryEnd::worn_out);
  EXPECT_EQ(run.worn_volume.size(), 1);
}

TEST(Block, SlidingUnderDeadLoadHasNoAsymptote) {
  scenes::Block data = stuck_block();
  data.tangential_load = 2.0 * data.friction * data.normal_load;
  data.tangential_spring = 1.0;
  const Asymptote worn = asymptote({condensed(data), {}, kBlock}, 1.0, kEveryRate);
  EXPECT_EQ(worn.verdict, Verdict::no_asymptote) << to_string(worn.status);
  EXPECT_TRUE(worn.confirmed_by_history);
  EXPECT_GT(worn.rate.maxCoeff(), 0.0);
}

TEST(Block, GapAndInterferenceShiftTheFloorOnly) {
  // The block floats: raising the floor by a constant moves it as a rigid body, and nothing else changes.
  const scenes::Block data = scenes::random_block(1);
  const Asymptote worn = asymptote({condensed(data), {}, kBlock}, 1.0, kEveryRate);
  ASSERT_GT(worn.worn_volume, 0.0);
  for (double shift : {-2e-3, 2e-3}) {
    reduction::ReducedModel model = scenes::block(data);
    model.contact.gap.array() += shift;
    const Asymptote moved =
        asymptote({std::make_shared<const dynamics::CondensedModel>(model), {}, kBlock}, 1.0, kEveryRate);
    ASSERT_EQ(moved.verdict, Verdict::asymptote);
    // The steady states are solved to 1e-9 of the excitation.
    EXPECT_NEAR(moved.worn_volume, worn.worn_volume, 1e-6 * worn.worn_volume);
  }
}

TEST(Block, IsNotAskedWithNodesReleasedAlready) {
  steady::Condition start;
  start.released.assign(static_cast<std::size_t>(condensed(stuck_block())->nodes()), 0);
  EXPECT_NO_THROW((void)asymptote({condensed(stuck_block()), start, kBlock}, 1.0, kEveryRate));
  start.released[0] = 1;
  EXPECT_THROW((void)asymptote({condensed(stuck_block()), start, kBlock}, 1.0, kEveryRate), InputError);
}

TEST(Block, HalvesAndReportsStepsThatFail) {
  // With no iterations to speak of, nothing converges: the history says so and invents no state.
  steady::Options hasty = kBlock;
  hasty.max_iterations = 1;
  hasty.penalty_cascade = false;
  const History run = history({condensed(scenes::random_block(1)), {}, hasty}, {.omega = 1.0}, {.rate_threshold = 0.0});
  EXPECT_EQ(run.end, HistoryEnd::failed);
  EXPECT_NE(run.status, Status::converged);
  EXPECT_EQ(run.cycles.size(), 0);
  const Asymptote worn = asymptote({condensed(scenes::random_block(1)), {}, hasty}, 1.0, kEveryRate);
  EXPECT_EQ(worn.verdict, Verdict::not_converged);
  EXPECT_NE(worn.status, Status::converged);
}

TEST(Block, StopsWhenAsked) {
  int asked = 0;
  const Watcher watcher{.stop = [&asked] { return ++asked > 4; }};
  const History run = history({condensed(scenes::random_block(1)), {}, kBlock}, {.omega = 1.0},
                              {.increment = 1e-6, .rate_threshold = 0.0}, watcher);
  EXPECT_EQ(run.status, Status::interrupted);
  EXPECT_EQ(run.cycles.size(), 4);  // four states were allowed and are kept
}

}  // namespace
}  // namespace dovetail::wear
