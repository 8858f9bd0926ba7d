#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "geometry/profile/exact_section.hpp"
#include "geometry/profile/flank_form.hpp"
#include "geometry/profile/measures.hpp"
#include "tests/unit/geometry/random_design.hpp"

namespace dovetail::geometry {
namespace {

using Eigen::Vector2d;

FlankParameters random_form(std::mt19937& generator) {
  std::uniform_real_distribution<double> unit(-1, 1);
  FlankParameters f;
  f.mismatch = 25e-6 * unit(generator);
  f.crown = 10e-6 * unit(generator);
  f.relief_length = 1.5e-3 * std::abs(unit(generator)) + 0.2e-3;
  f.relief_depth = 20e-6 * std::abs(unit(generator));
  const double radius = 100e-3 * unit(generator);
  if (radius > 5e-3) f.edge_radius = radius;
  return f;
}

TEST(FlankForm, HasTheSignsOfItsParameters) {
  FlankParameters f;
  EXPECT_EQ(FlankForm(f).gap(0.3), 0);
  f.mismatch = 20e-6;
  EXPECT_EQ(FlankForm(f).gap(0), 0);
  EXPECT_NEAR(FlankForm(f).gap(1), 20e-6, 1e-20);
  f.mismatch = -20e-6;
  EXPECT_NEAR(FlankForm(f).gap(0), 20e-6, 1e-20);
  EXPECT_NEAR(FlankForm(f).gap(1), 0, 1e-20);
  f = {.crown = 5e-6};
  EXPECT_NEAR(FlankForm(f).gap(0), 5e-6, 1e-20);
  EXPECT_NEAR(FlankForm(f).gap(0.5), 0, 1e-20);
  EXPECT_EQ(FlankForm(f).gap(0.5), 0);
  f.crown = -5e-6;
  EXPECT_NEAR(FlankForm(f).gap(0.5), 5e-6, 1e-20);
  EXPECT_NEAR(FlankForm(f).gap(1), 0, 1e-20);
  f = {.length = 5e-3, .relief_length = 1e-3, .relief_depth = 8e-6};
  EXPECT_NEAR(FlankForm(f).gap(0), 8e-6, 1e-20);
  EXPECT_NEAR(FlankForm(f).gap(0.9), 2e-6, 1e-19);
  EXPECT_NEAR(FlankForm(f).gap(0.5), 0, 1e-20);
}

TEST(FlankForm, RoundsOffItsEnds) {
  const double radius = 20e-3, w = rounded_length(radius);
  EXPECT_NEAR(w * w / (2 * radius), EdgeParams{}.drop, 1e-20);
  const FlankForm form({.length = 5e-3, .edge_radius = radius});
  EXPECT_NEAR(form.gap(0), EdgeParams{}.drop, 1e-20);
  EXPECT_NEAR(form.gap(1), EdgeParams{}.drop, 1e-20);
  EXPECT_EQ(form.gap(w / 5e-3), 0);
  EXPECT_EQ(form.gap(0.5), 0);
  // A circle that touches the flank at w from the end, to the fourth power of the distance.
  for (const double d : {50e-6, 200e-6, 400e-6})
    EXPECT_NEAR(form.gap((w - d) / 5e-3), radius - std::sqrt(radius * radius - d * d),
                std::pow(d, 4) / std::pow(radius, 3));
}

TEST(FlankForm, HasItsSmallestGapAtZero) {
  std::mt19937 generator(1);
  for (int trial = 0; trial < 300; ++trial) {
    FlankParameters f = random_form(generator);
    if (trial % 5 == 0) f.relief_length *= 4;  // reliefs that meet
    const FlankForm form(f);
    double smallest = 1;
    // gap() cuts at zero, so a shift that is too large shows as a slope or as a wide zero, one too small as > 0.
    int zeros = 0;
    for (int i = 0; i <= 1000; ++i) {
      smallest = std::min(smallest, form.gap(i / 1000.0));
      zeros += form.gap(i / 1000.0) == 0 ? 1 : 0;
    }
    // The vertex is within 5e-4 of a sample; the curvature is below 2 (4 crown + 2 depth length^2/relief^2) < 0.06 m,
    // 0.01 m of it roundings.
    EXPECT_LE(smallest, 1e-8);
    EXPECT_LE(zeros, 1) << trial;
  }
}

TEST(FinishedBlade, FollowsTheFormWithinItsStatedError) {
  std::mt19937 generator(3);
  for (int trial = 0; trial < 40; ++trial) {
    ProfileParameters p = random_design(generator, 0.05);
    const double length_right = p.flank("right").length;
    p.flank("right") = random_form(generator);
    p.flank("right").length = length_right;
    if (trial % 4 == 0) p.flank("right").relief_depth = 0.3e-3;  // a hundredfold relief is still followed
    const Chain blade = finished_blade(p);
    const Edge flank = edge(build_profile(p).blade, "flank_right");
    const Vector2d normal(std::cos(p.flank("right").angle), std::sin(p.flank("right").angle));
    const FlankForm form(p.flank("right"));
    double covered = 0;
    for (const Edge& e : blade) {
      if (e.name.rfind("flank_right_", 0) != 0) continue;
      for (int i = 0; i <= 50; ++i) {
        const Vector2d at = e.point(i / 50.0);
        const double s =
            std::clamp((flank.end - at).dot(flank.end - flank.start) / std::pow(flank.length(), 2), 0.0, 1.0);
        EXPECT_NEAR(-(at - flank.end).dot(normal), form.gap(s), FinishedParams{}.error) << e.name;
      }
      covered += (e.end - e.start).dot((flank.end - flank.start).normalized());
    }
    EXPECT_NEAR(covered, flank.length(), 1e-14);
  }
}

TEST(FinishedBlade, StaysClosedAndInsideTheNominalBlade) {
  std::mt19937 generator(4);
  for (int trial = 0; trial < 40; ++trial) {
    ProfileParameters p;
    p.flank("left") = random_form(generator);
    p.flank("right") = random_form(generator);
    const Chain blade = finished_blade(p);
    for (std::size_t i = 0; i < blade.size(); ++i) {
      EXPECT_EQ(blade[(i + 1) % blade.size()].start, blade[i].end) << blade[i].name;
      if (blade[i].is_arc()) {
        // Flat arcs of some metres radius: centre and radius are rounded to 1e-16 of themselves.
        EXPECT_NEAR((blade[i].end - blade[i].center).norm(), blade[i].radius, 1e-14 * (1 + blade[i].radius));
        EXPECT_NEAR((blade[i].point(1 - 1e-12) - blade[i].end).norm(), 0, 1e-13 * (1 + blade[i].radius));
      }
    }
    const double removed = area(build_profile(p).blade) - area(blade);
    double expected = 0;
    for (const FlankParameters& f : p.flanks)
      for (int i = 0; i < 2000; ++i) expected += FlankForm(f).gap((i + 0.5) / 2000) * f.length / 2000;
    // Besides the gap, fillets and corners change by about a third of the end gaps (50 um at most) times their 2-4 mm.
    EXPECT_GT(removed, 0);
    EXPECT_NEAR(removed, expected, 2 * 8e-3 * 50e-6 / 2);
  }
}

TEST(FinishedBlade, NeverEntersTheDisk) {
  std::mt19937 generator(5);
  for (int trial = 0; trial < 20; ++trial) {
    ProfileParameters p;
    p.flank("left") = random_form(generator);
    p.flank("right") = random_form(generator);
    const Chain blade = finished_blade(p);
    EXPECT_TRUE(is_simple(blade));
    EXPECT_LE(overlap_area(blade, build_profile(p).disk),
              FinishedParams{}.error * (p.flank("left").length + p.flank("right").length));
  }
}

TEST(FinishedBlade, IsTheNominalOneWithoutForm) {
  const Chain nominal = build_profile({}).blade;
  const Chain finished = finished_blade({});
  ASSERT_EQ(finished.size(), nominal.size());
  EXPECT_EQ(finished[2].name, "flank_right_1");
  EXPECT_FALSE(finished[2].is_arc());
  EXPECT_NEAR(area(finished), area(nominal), 1e-18);
}

}  // namespace
}  // namespace dovetail::geometry
