#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "paths/steady_state.hpp"
#include "tests/verification/steady/rod.hpp"

namespace dovetail::verification {
namespace {

// m = k = F_0 = 1 on rigid Coulomb friction of limit force f, frequency ratio b, moving without stops: between two
// turning points x = f + A cos t + B sin t + C cos bt + S sin bt from x_0 to -x_0 [Den Hartog 1931].
struct NonStop {
  double b, f;

  [[nodiscard]] double amplitude() const {
    const double v = 1 / (1 - b * b), u = std::tan(std::numbers::pi / (2 * b)) / b;
    return std::sqrt(v * v - f * f * u * u);
  }
  // Whether the velocity keeps its sign all the way.
  [[nodiscard]] bool holds() const {
    const double x = amplitude(), half = std::numbers::pi / b;
    if (!(x > 0)) return false;
    const double sine = f * std::sin(half) / (b * (1 + std::cos(half)));
    for (int i = 1; i < 2000; ++i) {
      const double t = half * i / 2000;
      const double velocity =
          f * std::sin(t) - b * sine * std::cos(t) - b * x * std::sin(b * t) + b * sine * std::cos(b * t);
      if (velocity >= 0) return false;
    }
    return true;
  }
  [[nodiscard]] static double limit(double b) {
    double low = 0, high = 1.5;
    for (int i = 0; i < 40; ++i) {
      const double middle = (low + high) / 2;
      (NonStop{b, middle}.holds() ? low : high) = middle;
    }
    return low;
  }
};

// The amplitude as H grows over 7, 15, 31, 63, each started from the one before. With mass on the contact the error of
// the series is c / (H + 1) + ..., which extrapolation removes twice.
double extrapolated(const NonStop& motion, int* failed) {
  std::array<double, 4> amplitude{};
  Eigen::MatrixXd guess;
  for (std::size_t i = 0; i < 4; ++i) {
    const int harmonics = (8 << i) - 1;
    Eigen::MatrixXd start;
    if (guess.size() > 0) {
      start = Eigen::MatrixXd::Zero(2, 2 * harmonics + 1);
      start.leftCols(guess.cols()) = guess;
    }
    const steady::State state = paths::steady_state(
        {condensed(den_hartog(motion.f)), {}, {.harmonics = harmonics, .samples = 32 * (harmonics + 1)}}, motion.b,
        start);
    if (state.status != Status::converged) ++*failed;
    guess = state.displacement;
    amplitude[i] = state.amplitudes(0);
  }
  const double once = 2 * amplitude[2] - amplitude[1], again = 2 * amplitude[3] - amplitude[2];
  return (4 * again - once) / 3;
}

TEST(DenHartog, HoldsOverFrequencyAndFrictionUpToTheNonStopLimit) {
  // Near the limit the velocity all but touches zero and the series is slow. Largest errors measured: 1e-4, 2e-3, 5e-3
  // at a tenth, half and nine tenths of the limit; at H = 63 without extrapolation 2e-3, 2e-2, 7e-2.
  for (const double b : {0.3, 0.5, 0.7, 0.9, 1.1, 1.4, 2.0})
    for (const double share : {0.1, 0.5, 0.9}) {
      const NonStop motion{b, share * NonStop::limit(b)};
      int failed = 0;
      const double error = std::abs(extrapolated(motion, &failed) / motion.amplitude() - 1);
      EXPECT_EQ(failed, 0) << b << " " << share;
      EXPECT_LT(error, share < 0.5 ? 2e-4 : share < 0.9 ? 3e-3 : 8e-3) << b << " " << share;
    }
}

TEST(DenHartog, HasTheKnownAmplitudes) {
  EXPECT_NEAR((NonStop{0.8, 0.4}.amplitude()), 2.501787881002, 1e-11);
  EXPECT_NEAR((NonStop{1.2, 0.4}.amplitude()), 1.902028159492, 1e-11);
  EXPECT_NEAR((NonStop{2.0, 0.4}.amplitude()), 0.266666666667, 1e-11);
  EXPECT_TRUE((NonStop{2.0, 0.59}.holds()));
  EXPECT_FALSE((NonStop{2.0, 0.61}.holds()));
}

}  // namespace
}  // namespace dovetail::verification
