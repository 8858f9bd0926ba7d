#include "paths/stationarity.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace dovetail::paths {
namespace {

constexpr double kTolerated = 1e-7;

// A curve by its logarithm and the slope of that.
struct Curve {
  std::function<double(double)> height, slope;
};

// Steps from `place` until the search has settled; returns the points that took, 200 when it does not.
int points_to(double& place, const Curve& curve, Stationarity search = {-1, 0.5}) {
  for (int points = 1; points < 200; ++points) {
    search.add(
        {.place = place, .omega = place, .amplitude = std::exp(curve.height(place)), .slope = curve.slope(place)});
    if (search.settled(kTolerated)) {
      EXPECT_LE(search.error(), kTolerated);
      return points;
    }
    place += search.step(kTolerated);
  }
  return 200;
}

TEST(Stationarity, FindsASmoothMaximumInAFewPoints) {
  double place = 0.6;
  const Curve wave{[](double x) { return std::cos(1 - x); }, [](double x) { return std::sin(1 - x); }};
  EXPECT_LE(points_to(place, wave), 6);
  EXPECT_NEAR(place, 1, kTolerated);
  place = 0.9;  // thirty times as sharp as the linear system whose curvature is the guess
  const Curve sharp{[](double x) { return 30 * std::cos(1 - x); }, [](double x) { return 30 * std::sin(1 - x); }};
  EXPECT_LE(points_to(place, sharp), 10);
  EXPECT_NEAR(place, 1, kTolerated);
}

TEST(Stationarity, FindsAMaximumWhereTheSlopeJumps) {
  const Curve roof{[](double x) { return x < 1 ? 0.4 * (x - 1) : 0.7 * (1 - x) - (1 - x) * (1 - x); },
                   [](double x) { return x < 1 ? 0.4 : -0.7 + 2 * (1 - x); }};
  double place = 0.6;
  EXPECT_LE(points_to(place, roof), 15);
  EXPECT_NEAR(place, 1, kTolerated);
}

// Beyond the maximum a point beside the branch, where samples are in the contact state they have before it.
TEST(Stationarity, TakesNoEndThatIsFurtherFromTheBranchThanTheBracketIsWide) {
  const Curve roof{[](double x) { return x < 1 ? 0.4 * (x - 1) : 0.7 * (1 - x); },
                   [](double x) { return x < 1 ? 0.4 : -0.7; }};
  Stationarity search(-1, 0.5);
  search.add({.place = 1.002, .omega = 1.002, .amplitude = 1, .slope = 0.4, .off = 1e-3});
  double place = 1.01;
  EXPECT_LE(points_to(place, roof, search), 60);
  EXPECT_NEAR(place, 1, kTolerated);
}

// A point on either side of a jump, as close as points come, and beyond it a slope that goes on rising.
TEST(Stationarity, IsNotLedToStopAtAJumpOnTheFlank) {
  const auto slope = [](double x) { return x < 0.8 ? 3.0 : 0.5 * (1.2 - x); };
  for (const double before : {1e-8, 1e-6, 1e-4}) {
    Stationarity search(-1, 0.5);
    search.add({.place = 0.8 - before, .omega = 1, .amplitude = 1, .slope = slope(0.8 - before)});
    double place = 0.8 + before;
    int points = 1;
    for (;; ++points) {
      search.add({.place = place, .omega = place, .amplitude = 1, .slope = slope(place)});
      if (search.settled(kTolerated) || points == 60) break;
      place += search.step(kTolerated);
    }
    EXPECT_LT(points, 30) << before;
    EXPECT_NEAR(place, 1.2, 3 * kTolerated) << before;
  }
}

}  // namespace
}  // namespace dovetail::paths
