#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "scenes.hpp"
#include "wear/history/history.hpp"

// Den Hartog's oscillator whose normal load falls as it wears, p_N = N_0 - k_n W: p(n) = (A/B) sech(s_0 + n/tau) with
// b = 0.8, mu = 0.4, N_0 = 1, k_n = 2, k_w = 1e-3 gives W(100) = 0.4430184939.

namespace dovetail::wear {
namespace {

constexpr double kDepth = 0.4430184939;

double depth_after_100_cycles(int harmonics, double increment) {
  const auto model = std::make_shared<const dynamics::CondensedModel>(scenes::den_hartog(0.4, 1.0, 2.0, 1e-3));
  const steady::Options steady{
      .harmonics = harmonics, .samples = 64 * harmonics, .slip_return = contact::SlipReturn::second_order};
  const HistoryOptions options{
      .increment = increment, .steps = 1000, .cycles = 100.0, .rate_fraction = 0.0, .rate_threshold = 0.0};
  const History run = history({model, {}, steady}, {.omega = 0.8}, options);
  EXPECT_EQ(run.status, Status::converged);
  EXPECT_EQ(run.end, HistoryEnd::cycles);
  const Eigen::Index last = run.cycles.size() - 1;
  EXPECT_DOUBLE_EQ(run.cycles[last], 100.0);
  return run.depth(last, 0);
}

TEST(DenHartogWear, ConvergesFirstOrderInTheIncrement) {
  // Explicit Euler: halving the increment halves the error. Ratio of successive differences 2 up to the second-order
  // term, of the size of the coarsest increment over the depth times a small number: 2 % times 5.
  const double coarse = depth_after_100_cycles(5, 0.01);
  const double middle = depth_after_100_cycles(5, 0.005);
  const double fine = depth_after_100_cycles(5, 0.0025);
  EXPECT_NEAR((coarse - middle) / (middle - fine), 2.0, 0.2);
}

TEST(DenHartogWear, ReachesTheClosedForm) {
  // The mass rubs directly, so truncation at H harmonics costs O(1/H): the error falls threefold from H = 7 to 21, and
  // what is left after extrapolating increment and H is a tenth of the finer error.
  const auto extrapolated = [](int harmonics) {
    return 2.0 * depth_after_100_cycles(harmonics, 0.005) - depth_after_100_cycles(harmonics, 0.01);
  };
  const double coarse = extrapolated(7);
  const double fine = extrapolated(21);
  RecordProperty("H7", std::to_string(coarse / kDepth - 1));
  RecordProperty("H21", std::to_string(fine / kDepth - 1));
  EXPECT_NEAR((coarse - kDepth) / (fine - kDepth), 3.0, 0.3);
  EXPECT_NEAR(fine + 0.5 * (fine - coarse), kDepth, 5e-4 * kDepth);
}

}  // namespace
}  // namespace dovetail::wear
