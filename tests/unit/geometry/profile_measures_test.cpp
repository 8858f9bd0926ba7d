#include "geometry/profile/measures.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "geometry/profile/chain.hpp"
#include "tests/unit/geometry/random_design.hpp"

namespace dovetail::geometry {
namespace {

using Eigen::Vector2d;
constexpr double kHalfTurn = std::numbers::pi;

/// The chain with each arc replaced by `pieces` chords.
Chain polygon(const Chain& chain, int pieces) {
  Chain chords;
  for (const Edge& e : chain)
    for (int i = 0; i < (e.is_arc() ? pieces : 1); ++i) {
      const double count = e.is_arc() ? pieces : 1;
      chords.push_back(line(e.name, e.point(i / count), e.point((i + 1) / count)));
    }
  return chords;
}

TEST(Measures, KnowTheAreaAndTheBoxOfADiskAndAHalfDisk) {
  const double r = 2e-3;
  const Vector2d at(0.1, 0.2);
  const auto place = [&](double angle) { return Vector2d(at + r * Vector2d(std::cos(angle), std::sin(angle))); };
  const Chain half{arc("arc", place(0), place(kHalfTurn), at, kHalfTurn), line("chord", place(kHalfTurn), place(0))};
  EXPECT_NEAR(area(half), kHalfTurn * r * r / 2, 1e-15 * r);
  const Eigen::AlignedBox2d box = bounding_box(half);
  EXPECT_NEAR((box.min() - at - Vector2d(-r, 0)).norm(), 0, 1e-15);
  EXPECT_NEAR((box.max() - at - Vector2d(r, r)).norm(), 0, 1e-15);

  const Chain quarters{arc("a", place(0), place(-kHalfTurn / 2), at, -kHalfTurn / 2),
                       arc("b", place(-kHalfTurn / 2), place(0), at, -1.5 * kHalfTurn)};
  EXPECT_NEAR(area(quarters), -kHalfTurn * r * r, 1e-15 * r) << "clockwise is negative";
}

TEST(Measures, AgreeWithRefinedPolygonsAtSecondOrder) {
  std::mt19937 generator(5);
  const Profile profile = build_profile(random_design(generator));
  for (const Chain* chain : {&profile.blade, &profile.disk}) {
    const double exact = area(*chain);
    const double coarse = area(polygon(*chain, 50)) - exact;
    const double fine = area(polygon(*chain, 100)) - exact;
    EXPECT_GT(std::abs(coarse), 1e-11);
    // Chord errors are sweep^3/(12 n^2) (1 - O(sweep^2/n^2)), sweep < 2.6: the ratio is 4 within 0.01.
    EXPECT_NEAR(coarse / fine, 4, 0.01);
  }
}

TEST(Measures, GiveTheMassOfTrapezoidAndRest) {
  ProfileParameters p;
  p.blend_radius = 0.01e-3;  // leaves a trapezoid but for 1e-11 m2
  const Profile profile = build_profile(p);
  const double trapezoid = (p.aerofoil_root_thickness + p.aerofoil_tip_thickness) / 2 * p.aerofoil_span;
  EXPECT_NEAR(area(aerofoil(profile)), trapezoid, 1e-10);
  p.chord = 30e-3;
  const double rest = area(profile.blade) - area(aerofoil(profile));
  EXPECT_NEAR(mass(p, 4430, 8000).blade, 4430 * (trapezoid * 30e-3 + rest * 40e-3), 4430 * 1e-10 * 30e-3);
  EXPECT_NEAR(mass(p, 4430, 8000).disk, 8000 * area(profile.disk) * 40e-3, 1e-12);
}

TEST(Measures, FindTheNarrowestPostByBruteForce) {
  std::mt19937 generator(6);
  for (int trial = 0; trial < 10; ++trial) {
    const ProfileParameters p = random_design(generator);
    const Profile profile = build_profile(p);
    const Measures m = measure(profile, p);
    const double angle = kHalfTurn / p.sectors;
    for (int side : {0, 1}) {
      const Edge& fillet = edge(profile.disk, side == 0 ? "slot_fillet_left" : "slot_fillet_right");
      double nearest = 1;
      for (int i = 0; i <= 20000; ++i) {
        const Vector2d at = fillet.point(i / 20000.0);
        nearest = std::min(nearest, at.y() * std::sin(angle) - std::abs(at.x()) * std::cos(angle));
      }
      // Nearest sample of the arc: spacing 5e-7 m, sagitta spacing^2/(8 r) = 2e-11 m.
      EXPECT_NEAR(m.slot_to_cut[static_cast<std::size_t>(side)], nearest, 3e-11);
    }
  }
}

}  // namespace
}  // namespace dovetail::geometry
