#include "geometry/profile/profile.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "geometry/profile/chain.hpp"
#include "geometry/profile/measures.hpp"
#include "tests/unit/geometry/random_design.hpp"

namespace dovetail::geometry {
namespace {

std::vector<std::string> names(const Chain& chain) {
  std::vector<std::string> list;
  for (const Edge& e : chain) list.push_back(e.name);
  return list;
}

/// Ends on the circle, sweep from start to end, neighbours sharing their end: all within rounding of coordinates
/// below 1 m (2e-16 m) times the few dozen operations behind them.
void expect_closed(const Chain& chain) {
  for (std::size_t i = 0; i < chain.size(); ++i) {
    const Edge& e = chain[i];
    EXPECT_EQ((chain[(i + 1) % chain.size()].start - e.end).norm(), 0) << e.name;
    if (!e.is_arc()) continue;
    EXPECT_NEAR((e.end - e.center).norm(), e.radius, 1e-14) << e.name;
    EXPECT_NEAR((e.center + Eigen::Rotation2D<double>(e.sweep) * (e.start - e.center) - e.end).norm(), 0, 1e-14)
        << e.name;
  }
}

bool is_corner(const std::string& from, const std::string& to) {
  const auto side = [](const std::string& name, const char* stem) { return name.rfind(stem, 0) == 0; };
  for (const auto& [a, b] : {std::pair{"shoulder", "shank"}, std::pair{"platform_bottom", "platform_side"},
                             std::pair{"platform_side", "platform_top"}, std::pair{"aerofoil_", "tip"},
                             std::pair{"bore", "cut"}, std::pair{"cut", "rim"}, std::pair{"rim", "mouth"}})
    if ((side(from, a) && side(to, b)) || (side(from, b) && side(to, a))) return true;
  return false;
}

TEST(Profile, ClosesAndIsTangentForRandomDesigns) {
  std::mt19937 generator(1);
  for (int trial = 0; trial < 200; ++trial) {
    const Profile profile = build_profile(random_design(generator));
    for (const Chain* chain : {&profile.blade, &profile.disk}) {
      expect_closed(*chain);
      for (std::size_t i = 0; i < chain->size(); ++i) {
        const Edge& from = (*chain)[i];
        const Edge& to = (*chain)[(i + 1) % chain->size()];
        if (is_corner(from.name, to.name)) continue;
        // A direction of an edge of 0.1 mm whose ends are rounded to 5e-17 m is good to 1e-12.
        EXPECT_NEAR((from.tangent(1) - to.tangent(0)).norm(), 0, 2e-12) << from.name << " -> " << to.name;
      }
    }
  }
}

TEST(Profile, HasTheSameEdgesInEveryDesign) {
  std::mt19937 generator(2);
  const Profile baseline = build_profile({});
  EXPECT_EQ(baseline.blade.size(), 28U);
  EXPECT_EQ(baseline.disk.size(), 16U);
  for (int trial = 0; trial < 100; ++trial) {
    const Profile profile = build_profile(random_design(generator));
    EXPECT_EQ(names(profile.blade), names(baseline.blade));
    EXPECT_EQ(names(profile.disk), names(baseline.disk));
  }
}

TEST(Profile, LetsTheFlanksOfBladeAndDiskCoincideToTheLastBit) {
  std::mt19937 generator(3);
  const Profile profile = build_profile(random_design(generator));
  for (const char* name : {"flank_left", "flank_right"}) {
    EXPECT_EQ(edge(profile.blade, name).start, edge(profile.disk, name).end);
    EXPECT_EQ(edge(profile.blade, name).end, edge(profile.disk, name).start);
  }
}

TEST(Profile, HasTheDimensionsAskedFor) {
  ProfileParameters p;
  p.flank("right").angle = 0.8;
  p.flank("right").length = 6e-3;
  const Profile profile = build_profile(p);
  const Edge& flank = edge(profile.blade, "flank_right");
  // Rounding of coordinates of 0.25 m: 3e-17 m, some operations.
  constexpr double kRounding = 1e-15;
  EXPECT_NEAR((flank.start - flank.end - 6e-3 * Eigen::Vector2d(std::sin(0.8), -std::cos(0.8))).norm(), 0, kRounding);
  EXPECT_NEAR(edge(profile.blade, "flank_left").length(), p.flank("left").length, kRounding);
  EXPECT_NEAR((flank.end.y() + edge(profile.blade, "flank_left").start.y()) / 2, p.rim_radius - p.lobe_depth,
              kRounding);
  EXPECT_EQ(edge(profile.blade, "neck_right").start.x(), p.neck_width / 2);
  EXPECT_NEAR((edge(profile.blade, "neck_right").length() + edge(profile.blade, "neck_left").length()) / 2,
              p.neck_height, kRounding);
  EXPECT_NEAR(edge(profile.blade, "neck_fillet_right").radius, p.neck_fillet_radius, kRounding);
  EXPECT_NEAR(edge(profile.blade, "root_corner_left").radius, p.root_corner_radius, kRounding);
  EXPECT_NEAR(edge(profile.disk, "lobe_right").radius, p.lobe_radius, kRounding);
  EXPECT_NEAR(edge(profile.disk, "slot_fillet_left").radius, p.slot_fillet_radius, kRounding);
  EXPECT_NEAR(edge(profile.disk, "rim_left").start.norm(), p.rim_radius, kRounding);
  EXPECT_NEAR(edge(profile.disk, "bore").radius, p.bore_radius, kRounding);
  EXPECT_NEAR(edge(profile.blade, "tip").length(), p.aerofoil_tip_thickness, kRounding);
  const Eigen::Vector2d cut = edge(profile.disk, "cut_right").tangent(0.5);
  EXPECT_NEAR(std::atan2(cut.x(), cut.y()), std::numbers::pi / p.sectors, 1e-14);
}

TEST(Profile, IsItsMirrorImageWhenTheFlanksAreExchanged) {
  std::mt19937 generator(4);
  ProfileParameters p = random_design(generator);
  const Profile profile = build_profile(p);
  std::swap(p.flank("left"), p.flank("right"));
  const Profile exchanged = build_profile(p);
  for (const auto& [chain, other] : {std::pair{&profile.blade, &exchanged.blade}, {&profile.disk, &exchanged.disk}}) {
    const Chain image = mirrored(*other);
    for (const Edge& e : *chain) {
      std::string name = e.name;
      if (const auto at = name.find("_left"); at != std::string::npos)
        name.replace(at, 5, "_right");
      else if (const auto place = name.find("_right"); place != std::string::npos)
        name.replace(place, 6, "_left");
      // Means of left and right are summed in either order: rounding only.
      EXPECT_NEAR((edge(image, name).start - e.start).norm(), 0, 1e-15) << name;
      EXPECT_NEAR((edge(image, name).end - e.end).norm(), 0, 1e-15) << name;
      EXPECT_NEAR(edge(image, name).sweep, e.sweep, 1e-14) << name;
    }
  }
}

TEST(Profile, RefusesWhatIsNotFiniteOrNotPositiveNamingEveryKey) {
  ProfileParameters p;
  p.neck_width = std::numeric_limits<double>::quiet_NaN();
  p.rim_radius = std::numeric_limits<double>::infinity();
  p.lobe_radius = 0;
  p.flank("left").length = -1e-3;
  try {
    static_cast<void>(build_profile(p));
    FAIL() << "accepted";
  } catch (const InputError& error) {
    ASSERT_EQ(error.violations().size(), 4U) << error.what();
    EXPECT_EQ(error.violations()[0].key, "geometry.rim_radius_mm");
    EXPECT_EQ(error.violations()[3].key, "geometry.left.flank_length_mm");
  }
}

TEST(ProfileParameters, HaveDefaultsWithinTheirRanges) {
  EXPECT_TRUE(violations(ProfileParameters{}).empty());
  EXPECT_TRUE(violations(FlankParameters{}).empty());
  EXPECT_TRUE(violations(FeasibilityLimits{}).empty());
  EXPECT_TRUE(violations(MeshSizes{}).empty());
}

}  // namespace
}  // namespace dovetail::geometry
