#include "geometry/profile.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

namespace dovetail::geometry {
namespace {

/// A design with every dimension moved by up to 15 % and the two flanks different.
ProfileParameters random_design(std::mt19937& generator) {
  std::uniform_real_distribution<double> factor(0.85, 1.15);
  ProfileParameters p;
  for (const Field<ProfileParameters>& field : option_table<ProfileParameters>())
    if (const auto* member = std::get_if<double ProfileParameters::*>(&field.member)) p.*(*member) *= factor(generator);
  p.shank_width = 1.2 * p.neck_width;  // leaves room for the blend of the shoulder
  p.sectors = std::uniform_int_distribution<int>(30, 60)(generator);
  for (FlankParameters* flank : {&p.left, &p.right}) {
    flank->angle *= factor(generator);
    flank->length *= std::uniform_real_distribution<double>(0.95, 1.05)(generator);
  }
  return p;
}

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

}  // namespace
}  // namespace dovetail::geometry
