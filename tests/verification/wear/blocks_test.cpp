#include <gtest/gtest.h>

#include <memory>

#include "scenes.hpp"
#include "wear/asymptote.hpp"
#include "wear/history.hpp"

namespace dovetail::wear {
namespace {

const response::SteadyOptions kSteady{.harmonics = 1, .samples = 64};
constexpr AsymptoteOptions kOptions{.rate_threshold = 0.0};

std::shared_ptr<const response::CondensedModel> condensed(const scenes::Block& data) {
  return std::make_shared<const response::CondensedModel>(scenes::block(data));
}

class RandomBlock : public testing::TestWithParam<unsigned> {};

// Ever finer histories converge to the direct answer, first order in the largest increment.
TEST_P(RandomBlock, HistoriesConvergeToTheAsymptote) {
  const auto model = condensed(scenes::random_block(GetParam()));
  const Asymptote worn = asymptote(model, 1.0, {}, kSteady, kOptions);
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
        model, 1.0, {}, kSteady,
        {.increment = fraction * worn.largest_depth, .steps = 3000, .rate_fraction = 1e-5, .rate_threshold = 0.0});
    EXPECT_EQ(run.end, HistoryEnd::worn_out) << to_string(run.end) << " " << to_string(run.status);
    const Eigen::VectorXd depth = run.depth.bottomRows(1).transpose();
    error = (depth - worn.depth).cwiseAbs().maxCoeff() / worn.largest_depth;
    RecordProperty("error_" + std::to_string(fraction), std::to_string(error));
    RecordProperty("jacobians_" + std::to_string(fraction), run.jacobians);
    // A node wears too deep by at most about the last increments.
    EXPECT_LT(error, 2.0 * fraction) << fraction;
  }
}
INSTANTIATE_TEST_SUITE_P(Six, RandomBlock, testing::Range(0u, 6u));

TEST(Block, WithoutSlipDoesNotWear) {
  scenes::Block data = scenes::random_block(0);
  data.tangential_load = 0.02 * data.friction * data.normal_load;
  data.height = 2.0;
  data.crown = 0.0;
  data.eccentricity = 0.0;
  const Asymptote worn = asymptote(condensed(data), 1.0, {}, kSteady, kOptions);
  EXPECT_EQ(worn.verdict, Verdict::asymptote);
}

TEST(Block, SlidingUnderDeadLoadHasNoAsymptote) {
  scenes::Block data = scenes::random_block(1);
  data.tangential_load = 1.2 * data.friction * data.normal_load;
  const Asymptote worn = asymptote(condensed(data), 1.0, {}, kSteady, kOptions);
  EXPECT_EQ(worn.verdict, Verdict::no_asymptote) << to_string(worn.status);
}

}  // namespace
}  // namespace dovetail::wear
