#include "geometry/profile/exact_section.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "geometry/profile/chain.hpp"
#include "geometry/profile/measures.hpp"

namespace dovetail::geometry {
namespace {

using Eigen::Vector2d;
constexpr double kPi = std::numbers::pi;

Chain circle(const Vector2d& at, double r) {
  const Vector2d right = at + Vector2d(r, 0);
  const Vector2d left = at - Vector2d(r, 0);
  return {arc("upper", right, left, at, kPi), arc("lower", left, right, at, kPi)};
}

Chain box(const Vector2d& low, const Vector2d& high) {
  ChainBuilder chain(low);
  chain.line_to("bottom", {high.x(), low.y()});
  chain.line_to("right", high);
  chain.line_to("top", {low.x(), high.y()});
  chain.line_to("left", low);
  return chain.chain();
}

TEST(ExactSection, FindsTheLensOfTwoCircles) {
  const double r = 2e-3, d = 3e-3;
  const double lens = 2 * r * r * std::acos(d / (2 * r)) - d / 2 * std::sqrt(4 * r * r - d * d);
  // Ends rounded to 1 pm along a boundary of some mm.
  EXPECT_NEAR(overlap_area(circle({0, 0.2}, r), circle({d, 0.2}, r)), lens, 2e-14);
  EXPECT_EQ(overlap_area(circle({0, 0.2}, r), circle({2.1 * r, 0.2}, r)), 0);
  EXPECT_NEAR(overlap_area(circle({0, 0.2}, r), circle({0, 0.2}, r / 2)), kPi * r * r / 4, 2e-14) << "one in the other";
}

TEST(ExactSection, GivesCommonBoundaryNoArea) {
  const Chain left = box({0, 0}, {1e-3, 2e-3});
  EXPECT_EQ(overlap_area(left, box({1e-3, 0.5e-3}, {2e-3, 1e-3})), 0);
  EXPECT_NEAR(overlap_area(left, box({1e-3 - 1e-9, 0.5e-3}, {2e-3, 1e-3})), 1e-9 * 0.5e-3, 1e-15);
}

TEST(ExactSection, KnowsSimpleChains) {
  EXPECT_TRUE(is_simple(circle({0.1, 0.2}, 2e-3)));
  EXPECT_TRUE(is_simple(build_profile({}).blade));
  EXPECT_TRUE(is_simple(build_profile({}).disk));
  ChainBuilder bow({0, 0});
  bow.line_to("a", {1e-3, 1e-3});
  bow.line_to("b", {1e-3, 0});
  bow.line_to("c", {0, 1e-3});
  bow.line_to("d", {0, 0});
  EXPECT_FALSE(is_simple(bow.chain()));
  ChainBuilder back({0, 0});  // a straight part of negative length between two tangent lines
  back.line_to("a", {2e-3, 0});
  back.line_to("b", {1e-3, 0});
  back.line_to("c", {1e-3, 1e-3});
  back.line_to("d", {0, 0});
  EXPECT_FALSE(is_simple(back.chain()));
}

TEST(ExactSection, SeesNoOverlapInTheNominalSectionBesidesRounding) {
  const Profile profile = build_profile({});
  EXPECT_LE(overlap_area(profile.blade, profile.disk), ExactParams{}.noise);
}

TEST(ExactSection, SeesAMicrometreOfInterference) {
  const Profile profile = build_profile({});
  Chain lifted = profile.blade;
  for (Edge& e : lifted)
    for (Vector2d* at : {&e.start, &e.end, &e.center}) at->y() += 1e-6;
  // Both flanks enter by 1 um times their width; the fillets beside them add a little.
  const double flanks = 1e-6 * 2 * 5.5e-3 * std::sin(ProfileParameters{}.flank("right").angle);
  const double overlap = overlap_area(lifted, profile.disk);
  EXPECT_GT(overlap, flanks);
  EXPECT_LT(overlap, 1.1 * flanks);
}

}  // namespace
}  // namespace dovetail::geometry
