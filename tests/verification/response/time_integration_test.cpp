#include "tests/verification/response/time_integration.hpp"

#include <gtest/gtest.h>

#include "response/steady_state.hpp"
#include "tests/verification/response/rod.hpp"

namespace dovetail::verification {
namespace {

TEST(TimeIntegration, OfTheSingleNodeHasTheKnownFrictionEnergy) {
  const Periodic motion = march_in_time(single_node(), 1.1, 2048);
  ASSERT_GT(motion.periods, 0);
  // Second order: 5.9e-5, 1.5e-5, 4.2e-6 measured with 512, 1024, 2048 steps.
  EXPECT_NEAR(motion.friction_energy / 11.4313802832, 1, 6e-6);
}

}  // namespace
}  // namespace dovetail::verification
