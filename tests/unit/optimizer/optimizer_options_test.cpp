#include "optimizer/problem/optimizer_options.hpp"

#include <gtest/gtest.h>

namespace dovetail::optimizer {
namespace {

TEST(OptimizerOptions, DefaultsAreAllowed) {
  EXPECT_TRUE(violations(OptimizerOptions{}).empty());
}

TEST(OptimizerOptions, ReportsEveryValueOutsideItsRange) {
  OptimizerOptions options;
  options.algorithm = static_cast<Algorithm>(-1);
  options.max_evaluations = 0;
  options.noise = -1;
  const std::vector<Violation> found = violations(options, "optimizer");
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[0].key, "optimizer.algorithm");
  EXPECT_EQ(found[1].key, "optimizer.max_evaluations");
}

TEST(OptimizerOptions, DifferenceStepGrowsWithNoise) {
  OptimizerOptions options;
  options.noise = 1e-6;
  EXPECT_DOUBLE_EQ(difference_step(options), 2e-3);
  options.noise = 0;  // not known
  EXPECT_DOUBLE_EQ(difference_step(options), 2e-3);
  options.noise = 1e-20;
  EXPECT_DOUBLE_EQ(difference_step(options), 1e-7);
  options.noise = 0.5;
  EXPECT_DOUBLE_EQ(difference_step(options), 0.1);
  options.noise = 9e-6;
  options.difference = Difference::central;
  EXPECT_DOUBLE_EQ(difference_step(options), 0.03);
}

TEST(OptimizerOptions, StoppingStepStaysBelowTheFirst) {
  OptimizerOptions options;
  options.noise = 0.01;
  EXPECT_DOUBLE_EQ(stopping_step(options), 0.01);
  options.initial_step = 0.01;
  EXPECT_DOUBLE_EQ(stopping_step(options), 0.005);
}

}  // namespace
}  // namespace dovetail::optimizer
