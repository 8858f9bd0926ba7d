#include "geometry/rules/solid_rules.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "geometry/rules/params.hpp"
#include "tests/unit/geometry/solid_checks.hpp"

namespace dovetail::geometry {
namespace {

const Rule& named(const std::vector<Rule>& rules, const std::string& name) {
  return *std::find_if(rules.begin(), rules.end(), [&](const Rule& rule) { return rule.name == name; });
}

TEST(SolidRules, AreKeptByTheDefault) {
  const Feasibility result = check_feasibility({}, SolidParameters{});
  EXPECT_TRUE(result.feasible);
  EXPECT_EQ(result.rules.size(), check_feasibility({}).rules.size() + solid_rules({}, {}).size());
}

TEST(SolidRules, ReduceToTheSectionsDistancesWithoutSkew) {
  const std::vector<Rule> section = check_feasibility({}).rules, solid = solid_rules({}, {});
  for (const char* part : {"slot_left_within_cut", "mouth_right_within_cut"})
    EXPECT_NEAR(named(solid, std::string(part) + "_at_ends").margin, named(section, part).margin, 1e-10);
  for (const char* side : {"left", "right"})
    EXPECT_NEAR(named(solid, std::string("platform_") + side + "_within_cut_at_ends").margin,
                named(section, "platform_within_pitch").margin, 1e-10);
}

TEST(SolidRules, MeasureHowFarTheAerofoilOverhangsThePlatform) {
  // Half the platform 15 mm, the blend's foot at 2 + 1 mm but for the tilt of the sides: 12 mm beside the aerofoil.
  const Rule rule = named(solid_rules({}, {.stagger = 15 * kRadian}), "aerofoil_on_platform");
  EXPECT_NEAR(rule.margin, 0.8 * 12 - 20 * std::sin(15 * kRadian), 0.01);
  EXPECT_THAT(rule.sentence, ::testing::HasSubstr("platform"));
  EXPECT_LT(named(solid_rules({}, {.stagger = 35 * kRadian}), "aerofoil_on_platform").margin, 0);
  // A slot skewed alike leaves the aerofoil in the middle of its platform.
  EXPECT_NEAR(
      named(solid_rules({}, {.skew_angle = 20 * kRadian, .stagger = 20 * kRadian}), "aerofoil_on_platform").margin,
      0.8 * 12, 0.01);
}

TEST(SolidRules, RefusePlatformsThatFold) {
  ProfileParameters p;
  p.chord = 20e-3;
  EXPECT_GE(named(solid_rules(p, {}), "platform_follows_aerofoil").margin, 0);
  EXPECT_NEAR(named(solid_rules({}, {}), "platform_follows_aerofoil").margin, 1 - RuleParams{}.stretch, 1e-14);
  EXPECT_LT(named(solid_rules(p, {.stagger = 45 * kRadian}), "platform_follows_aerofoil").margin, 0);
}

TEST(SolidRules, TakeTheNarrowerEndOfASkewedSlot) {
  for (const double skew : {-20 * kRadian, 20 * kRadian}) {
    const std::vector<Rule> straight = solid_rules({}, {}), rules = solid_rules({}, {.skew_angle = skew});
    for (const char* name : {"slot_left_within_cut_at_ends", "slot_right_within_cut_at_ends",
                             "platform_left_within_cut_at_ends", "mouth_right_within_cut_at_ends"})
      EXPECT_LT(named(rules, name).margin, named(straight, name).margin) << name;
  }
}

TEST(SolidRules, KeepTheRelievedEndsOfTheSlotApart) {
  const SolidParameters solid{.skew_angle = 30 * kRadian, .axial_relief_length = 22e-3, .axial_relief_depth = 5e-6};
  EXPECT_NEAR(named(solid_rules({}, solid), "axial_relief_fits").margin, 40 / std::cos(30 * kRadian) - 44, 1e-9);
  EXPECT_LT(named(solid_rules({}, {.axial_relief_length = 22e-3}), "axial_relief_fits").margin, 0);
}

}  // namespace
}  // namespace dovetail::geometry
