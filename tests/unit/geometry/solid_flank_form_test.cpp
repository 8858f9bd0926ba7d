#include <gtest/gtest.h>

#include <algorithm>

#include "geometry/solid/solid_flank.hpp"
#include "tests/unit/geometry/solid_checks.hpp"

namespace dovetail::geometry {
namespace {

TEST(SolidFlankForm, IsThePlaneFormWithoutAxialTerms) {
  FlankParameters flank;
  flank.mismatch = 12e-6;
  flank.crown = 3e-6;
  const FlankForm plane(flank);
  const SolidFlankForm solid(flank, {}, {});
  for (const double s : {0.0, 0.3, 1.0})
    for (const double u : {0.0, 0.4, 1.0}) EXPECT_EQ(solid.gap(s, u), plane.gap(s));
}

TEST(SolidFlankForm, AddsCrownAndReliefAlongTheSlot) {
  const ProfileParameters p;
  const SolidParameters crown{.axial_crown = 6e-6};
  const SolidFlankForm crowned(p.flank("left"), p, crown);
  EXPECT_NEAR(crowned.gap(0.2, 0), 6e-6, 1e-20);
  EXPECT_NEAR(crowned.gap(0.2, 0.5), 0, 1e-20);
  EXPECT_NEAR(crowned.gap(0.2, 0.75), 1.5e-6, 1e-20);
  const SolidFlankForm hollow(p.flank("left"), p, {.axial_crown = -6e-6});
  EXPECT_NEAR(hollow.gap(0.2, 0.5), 6e-6, 1e-20);
  EXPECT_NEAR(hollow.gap(0.2, 1), 0, 1e-20);
  // 4 mm of 40 mm: half-way into the relief a quarter of its depth is left.
  const SolidFlankForm relieved(p.flank("left"), p, {.axial_relief_length = 4e-3, .axial_relief_depth = 8e-6});
  EXPECT_NEAR(relieved.gap(0.7, 0), 8e-6, 1e-20);
  EXPECT_NEAR(relieved.gap(0.7, 0.05), 2e-6, 1e-19);
  EXPECT_NEAR(relieved.gap(0.7, 0.5), 0, 1e-20);
  EXPECT_NEAR(relieved.gap(0.7, 0.95), 2e-6, 1e-19);
}

TEST(SolidFlankForm, MeasuresTheReliefAlongASkewedSlot) {
  // cos 60 = 1/2 is out of range; at 30 degrees the slot is 2/sqrt(3) longer, so 4 mm are a smaller part of it.
  const ProfileParameters p;
  const SolidParameters solid{.skew_angle = 30 * kRadian, .axial_relief_length = 4e-3, .axial_relief_depth = 8e-6};
  const double border = 4e-3 * std::cos(30 * kRadian) / 40e-3;
  const SolidFlankForm form(p.flank("left"), p, solid);
  EXPECT_NEAR(form.gap(0.5, border / 2), 2e-6, 1e-19);
  EXPECT_NEAR(form.gap(0.5, 1.01 * border), 0, 1e-20);
}

TEST(SolidFlankForm, HasItsSmallestGapAtZero) {
  ProfileParameters p;
  p.flank("left").mismatch = -7e-6;
  p.flank("left").crown = -4e-6;
  const SolidFlankForm form(p.flank("left"), p, everything());
  double smallest = 1;
  for (int i = 0; i <= 200; ++i)
    for (int j = 0; j <= 200; ++j) smallest = std::min(smallest, form.gap(i / 200.0, j / 200.0));
  EXPECT_GE(smallest, 0);
  EXPECT_LE(smallest, 1e-9);  // curvatures of some um over a grid of 1/200: below 1e-10
}

}  // namespace
}  // namespace dovetail::geometry
