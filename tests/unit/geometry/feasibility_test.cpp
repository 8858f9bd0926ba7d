#include "geometry/rules/feasibility.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <ostream>
#include <random>
#include <set>

#include "geometry/profile/exact_section.hpp"
#include "geometry/profile/measures.hpp"
#include "tests/unit/geometry/random_design.hpp"

namespace dovetail::geometry {
namespace {

std::set<std::string> broken(const Feasibility& result) {
  std::set<std::string> names;
  for (const Rule& rule : result.rules)
    if (rule.margin < 0) names.insert(rule.name);
  return names;
}

const Rule& rule(const Feasibility& result, const std::string& name) {
  for (const Rule& candidate : result.rules)
    if (candidate.name == name) return candidate;
  throw std::out_of_range(name);
}

TEST(Feasibility, HoldsForTheDefaults) {
  const Feasibility result = check_feasibility({});
  EXPECT_TRUE(result.feasible) << testing::PrintToString(broken(result));
  EXPECT_EQ(result.overlap_area, 0);
}

TEST(Feasibility, ListsTheSameRulesForEveryDesign) {
  const auto names = [](const Feasibility& result) {
    std::vector<std::string> list;
    for (const Rule& r : result.rules) {
      EXPECT_FALSE(r.sentence.empty());
      list.push_back(r.name);
    }
    return list;
  };
  const std::vector<std::string> baseline = names(check_feasibility({}));
  EXPECT_EQ(std::set<std::string>(baseline.begin(), baseline.end()).size(), baseline.size()) << "names are unique";
  std::mt19937 generator(1);
  for (int trial = 0; trial < 20; ++trial) EXPECT_EQ(names(check_feasibility(random_design(generator, 0.4))), baseline);
}

struct Case {
  std::string name;
  std::function<void(ProfileParameters&, FeasibilityLimits&)> change;
  std::set<std::string> breaks;  ///< exactly these rules
};

void PrintTo(const Case& tested, std::ostream* out) {
  *out << tested.name;
}

class FeasibilityRules : public testing::TestWithParam<Case> {};

TEST_P(FeasibilityRules, AreBrokenByTheDesignMadeForThem) {
  ProfileParameters p;
  FeasibilityLimits limits;
  GetParam().change(p, limits);
  const Feasibility result = check_feasibility(p, limits);
  EXPECT_FALSE(result.feasible);
  EXPECT_EQ(broken(result), GetParam().breaks);
}

using P = ProfileParameters;
using L = FeasibilityLimits;
const std::vector<Case> kCases{
    {"NeckWall",
     [](P& p, L&) {
       p.neck_width = 1.9e-3;
       p.flank("left").length = p.flank("right").length = 9e-3;
     },
     {"neck_wall"}},
    {"PostWall",
     [](P& p, L&) {
       p.sectors = 68;
       p.platform_width = 18e-3;
     },
     {"post_wall"}},
    {"LobeWall",
     [](P& p, L&) {
       p.lobe_depth = 1.9e-3;
       p.neck_height = 2e-3;
     },
     {"lobe_wall"}},
    {"PlatformWall", [](P& p, L&) { p.platform_thickness = 1.9e-3; }, {"platform_wall"}},
    {"AerofoilRoot", [](P& p, L&) { p.aerofoil_root_thickness = 1.8e-3; }, {"aerofoil_root_wall"}},
    {"AerofoilTip", [](P& p, L&) { p.aerofoil_tip_thickness = 1.8e-3; }, {"aerofoil_tip_wall"}},
    {"Web", [](P& p, L&) { p.bore_radius = 0.238; }, {"web_wall"}},
    {"SlotThroughBore", [](P& p, L&) { p.bore_radius = 0.2405; }, {"web_wall", "disk_simple", "no_overlap"}},
    {"UnequalFlanks",
     [](P& p, L&) {
       p.neck_height = 1.5e-3;
       p.lobe_depth = 2e-3;
       p.flank("left").length = 3e-3;
       p.flank("right").length = 9e-3;
     },
     {"neck_right_fits", "mouth_right_fits", "blade_simple", "disk_simple", "no_overlap"}},
    {"Shoulder", [](P& p, L&) { p.shank_width = p.neck_width + 0.5e-3; }, {"shoulder_fits"}},
    {"ShankNarrowerThanNeck",
     [](P& p, L&) { p.shank_width = p.neck_width - 0.5e-3; },
     {"shoulder_fits", "blade_simple", "no_overlap"}},
    {"Shank", [](P& p, L&) { p.shank_height = 2e-3; }, {"shank_fits"}},
    {"PlatformUnderside", [](P& p, L&) { p.platform_width = 11e-3; }, {"platform_underside_fits"}},
    {"PlatformTop", [](P& p, L&) { p.aerofoil_root_thickness = 29e-3; }, {"platform_top_fits"}},
    {"Aerofoil",
     [](P& p, L&) {
       p.aerofoil_span = 0.9e-3;
       p.aerofoil_tip_thickness = p.aerofoil_root_thickness;
     },
     {"aerofoil_fits"}},
    {"RootBottom",  // a straight root bottom of 20 um
     [](P& p, L&) {
       p.flank("left").length = p.flank("right").length = 1.5e-3;
       p.flank("left").angle = p.flank("right").angle = 0.55;
       p.neck_width = 2.1e-3;
       p.root_corner_radius = p.slot_fillet_radius = 2.486e-3;
     },
     {"root_bottom_fits"}},
    {"SlotFloor",  // a straight slot floor of 20 um
     [](P& p, L&) {
       p.flank("left").length = p.flank("right").length = 2e-3;
       p.neck_width = 7e-3;
       p.slot_fillet_radius = 9.8515e-3;
     },
     {"slot_floor_fits"}},
    {"Mouth",  // straight mouth sides of 20 um
     [](P& p, L&) {
       p.lobe_radius = 3.842e-3;
       p.neck_fillet_radius = 4e-3;
     },
     {"mouth_left_fits", "mouth_right_fits"}},
    {"Runout",
     [](P& p, L&) {
       p.bottom_clearance = 0.05e-3;
       p.slot_fillet_radius = 4e-3;
       p.flank("left").angle = 0.8;
       p.flank("right").angle = 0.95;
     },
     {"runout_right_fits", "no_overlap"}},
    {"BottomGap",
     [](P& p, L&) { p.root_corner_radius = 2.5e-3; },
     {"root_corner_within_slot_fillet", "bottom_gap", "no_overlap"}},
    {"ShankAboveRim", [](P& p, L&) { p.neck_height = 1e-3; }, {"shank_above_rim"}},
    {"Platform", [](P& p, L&) { p.platform_width = 36e-3; }, {"platform_within_pitch"}},
    {"SlotAcrossCut",
     [](P& p, L&) {
       p.sectors = 90;
       p.platform_width = 17.5e-3;
     },
     {"post_wall", "slot_left_within_cut", "slot_right_within_cut", "disk_simple", "no_overlap"}},
    {"MouthAcrossCut",
     [](P& p, L&) {
       p.sectors = 200;
       p.platform_width = 17.5e-3;
     },
     {"post_wall", "slot_left_within_cut", "slot_right_within_cut", "mouth_left_within_cut", "mouth_right_within_cut",
      "platform_within_pitch", "disk_simple", "no_overlap"}},
    {"Lobe", [](P& p, L&) { p.lobe_radius = 2e-3; }, {"lobe_within_neck_fillet"}},
    {"LobeLargerThanNeckFillet", [](P& p, L&) { p.lobe_radius = 2.5e-3; }, {"lobe_within_neck_fillet", "no_overlap"}},
    {"OneCutter", [](P&, L& l) { l.minimum_cutter_radius = 1.5e-3; }, {"blend_cutter"}},
    {"AllCutters",
     [](P&, L& l) { l.minimum_cutter_radius = 2.1e-3; },
     {"blend_cutter", "neck_fillet_cutter", "slot_fillet_cutter"}},
    {"Relief", [](P& p, L&) { p.flank("left").relief_length = 3e-3; }, {"relief_left_fits"}},
    {"EdgeRadius", [](P& p, L&) { p.flank("left").edge_radius = 0.2; }, {"edge_left_fits"}},
    {"SelfLocking",
     [](P& p, L& l) {
       p.flank("right").angle = 0.8;
       l.friction = 1.1;
     },
     {"self_locking_right"}},
};
INSTANTIATE_TEST_SUITE_P(EachInTurn, FeasibilityRules, testing::ValuesIn(kCases),
                         [](const auto& tested) { return tested.param.name; });

TEST(Feasibility, HasACaseForEveryRule) {
  std::set<std::string> all;
  for (const Rule& r : check_feasibility({}).rules) {
    const auto side = r.name.find("left");  // the mirrored rules are told by their right one, or both at once
    if (side == std::string::npos) all.insert(r.name);
  }
  std::set<std::string> tested{"relief_right_fits", "edge_right_fits"};  // tested on the left
  for (const Case& c : kCases) tested.insert(c.breaks.begin(), c.breaks.end());
  for (const std::string& name : all) EXPECT_TRUE(tested.contains(name)) << name;
}

TEST(Feasibility, SaysByHowMuchARuleIsBroken) {
  ProfileParameters p;
  p.platform_thickness = 1.5e-3;
  p.flank("left").angle = std::numbers::pi / 9;
  const Feasibility result = check_feasibility(p);
  EXPECT_EQ(
      rule(result, "platform_wall").sentence,
      "the thickness of the platform is 1.5 mm; it must be at least 2 mm as the thinnest wall allowed (0.5 mm short)");
  EXPECT_NEAR(rule(result, "platform_wall").margin, -0.25, 1e-12);
  // atan 0.5 = 26.57 degrees.
  EXPECT_THAT(rule(result, "self_locking_left").sentence, testing::HasSubstr("is 20 degrees"));
  EXPECT_THAT(rule(result, "self_locking_left").sentence, testing::HasSubstr("(6.565 degrees short)"));
}

TEST(Feasibility, FollowsClosedFormsForNearlyAllRandomDesigns) {
  // Where all closed forms hold, the exact checks agree: the closed forms are complete on this box.
  std::mt19937 generator(2);
  int kept = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const ProfileParameters p = random_design(generator, 0.25);
    const Feasibility result = check_feasibility(p);
    bool closed_forms = true;
    for (const Rule& r : closed_form_rules(p, {})) closed_forms = closed_forms && r.margin >= 0;
    EXPECT_EQ(result.feasible, closed_forms) << testing::PrintToString(broken(result));
    kept += closed_forms ? 1 : 0;
  }
  EXPECT_GT(kept, 5);
}

TEST(Feasibility, HasSmoothMargins) {
  // Second differences of a smooth margin fall fourfold when the step is halved; a kink makes them fall twofold.
  const ProfileParameters p;
  for (const Field<ProfileParameters>& field : option_table<ProfileParameters>()) {
    const auto* member = std::get_if<double ProfileParameters::*>(&field.member);
    if (member == nullptr) continue;
    const auto margins = [&](double factor) {
      ProfileParameters moved = p;
      moved.*(*member) *= factor;
      return closed_form_rules(moved, {});
    };
    const std::vector<Rule> middle = margins(1);
    const auto bend = [&](double h, std::size_t i) {
      return margins(1 + h)[i].margin - 2 * middle[i].margin + margins(1 - h)[i].margin;
    };
    for (std::size_t i = 0; i < middle.size(); ++i) {
      const double coarse = bend(0.02, i);
      const double fine = bend(0.01, i);
      // Fourth derivatives are mild over 2 % (the rim's root is the strongest): 3 % of the second difference;
      // rounding of coordinates of 0.25 m in units of 1 mm: 1e-12.
      EXPECT_NEAR(coarse, 4 * fine, 0.03 * std::abs(coarse) + 1e-11) << field.key << " " << middle[i].name;
    }
  }
}

TEST(Feasibility, SeesADiskInsideOut) {
  // A bore beyond the slots turns the disk's outline round without a crossing: nothing for a set of polygons.
  ProfileParameters p;
  p.bore_radius = 0.26;
  const Profile profile = build_profile(p);
  ASSERT_TRUE(is_simple(profile.disk));
  ASSERT_LT(area(profile.disk), 0);
  const Feasibility result = check_feasibility(p);
  EXPECT_FALSE(result.feasible);
  EXPECT_LT(rule(result, "disk_simple").margin, 0);
  EXPECT_EQ(rule(result, "disk_simple").sentence, "the outline of the disk is inside out");
  EXPECT_LT(rule(result, "no_overlap").margin, 0);
  EXPECT_EQ(result.overlap_area, 0);
}

TEST(Feasibility, MeasuresHowDeepBladeAndDiskOverlap) {
  // Raising the rim into the platform: a shank lowered by neck_height enters the rim on both sides.
  ProfileParameters p;
  p.platform_width = 25e-3;
  std::vector<double> margins;
  for (double neck_height : {1.0e-3, 0.6e-3, 0.5e-3, 0.4e-3}) {
    p.neck_height = neck_height;
    p.shank_width = 12e-3;
    const Feasibility result = check_feasibility(p);
    margins.push_back(rule(result, "no_overlap").margin);
    if (result.overlap_area > 0) {
      EXPECT_NEAR(margins.back(), -result.overlap_area / 11e-3 / 1e-3, 1e-12);
    }
  }
  EXPECT_LT(margins[1], 0);
  EXPECT_LT(margins[2], margins[1]);
  EXPECT_LT(margins[3], margins[2]);
}

TEST(Feasibility, IsTheSameForTheMirrorImage) {
  std::mt19937 generator(3);
  for (int trial = 0; trial < 5; ++trial) {
    ProfileParameters p = random_design(generator, 0.25);
    const Feasibility one = check_feasibility(p);
    std::swap(p.flank("left"), p.flank("right"));
    const Feasibility other = check_feasibility(p);
    EXPECT_EQ(one.feasible, other.feasible);
    for (const Rule& r : one.rules) {
      std::string name = r.name;
      if (const auto at = name.find("left"); at != std::string::npos)
        name.replace(at, 4, "right");
      else if (const auto place = name.find("right"); place != std::string::npos)
        name.replace(place, 5, "left");
      EXPECT_NEAR(rule(other, name).margin, r.margin, 1e-9) << name;
    }
  }
}

TEST(Feasibility, RefusesLimitsOutOfRange) {
  EXPECT_THROW(static_cast<void>(check_feasibility({}, {.friction = -0.1})), InputError);
  EXPECT_THROW(static_cast<void>(check_feasibility({}, {.minimum_wall = std::nan("")})), InputError);
}

}  // namespace
}  // namespace dovetail::geometry
