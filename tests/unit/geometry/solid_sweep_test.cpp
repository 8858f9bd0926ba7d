#include "geometry/solid/slot_sweep.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "geometry/profile/measures.hpp"
#include "tests/unit/geometry/solid_checks.hpp"

namespace dovetail::geometry {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

class SkewedSection : public ::testing::Test {
 protected:
  const ProfileParameters parameters_{};
  const SolidParameters solid_{.skew_angle = 20 * kRadian};
  const Profile plane_ = build_profile(parameters_);
  const double z_ = 17e-3;
  const double shift_ = z_ * std::tan(20 * kRadian);
  const Profile section_ = section_at(plane_, parameters_, solid_, z_);
};

TEST_F(SkewedSection, HasClosedChainsOfTheSameEdges) {
  for (const auto& [chain, plane] :
       {std::pair{&section_.blade, &plane_.blade}, std::pair{&section_.disk, &plane_.disk}})
    for (std::size_t i = 0; i < chain->size(); ++i) {
      const Edge &e = (*chain)[i], &next = (*chain)[(i + 1) % chain->size()];
      EXPECT_EQ(e.name, (*plane)[i].name);
      EXPECT_LE((e.end - next.start).norm(), 1e-16) << e.name;  // last bit of 0.25 m
      if (e.is_arc()) {
        EXPECT_NEAR((e.start - e.center).norm(), e.radius, 1e-15) << e.name;
        EXPECT_NEAR((e.end - e.center).norm(), e.radius, 1e-15) << e.name;
        EXPECT_LE((e.center + Eigen::Rotation2D<double>(e.sweep) * (e.start - e.center) - e.end).norm(), 2e-16 * 10)
            << e.name;
      }
    }
}

TEST_F(SkewedSection, MovesBladeAndSlotAlongTheSlot) {
  for (std::size_t i = 0; i < plane_.blade.size(); ++i)
    EXPECT_LE((section_.blade[i].start - plane_.blade[i].start - Vector2d(shift_, 0)).norm(), 1e-16);
  for (const char* name : {"lobe_right", "flank_right", "slot_floor", "slot_fillet_left", "flank_left"})
    EXPECT_LE((edge(section_.disk, name).start - edge(plane_.disk, name).start - Vector2d(shift_, 0)).norm(), 1e-16);
}

TEST_F(SkewedSection, TurnsCutsAndBoreAboutTheAxis) {
  const Eigen::Rotation2D<double> pitch(-2 * std::numbers::pi / parameters_.sectors);
  const Edge &left = edge(section_.disk, "cut_left"), &right = edge(section_.disk, "cut_right");
  EXPECT_LE((pitch * left.end - right.start).norm(), 1e-15);
  EXPECT_LE((pitch * left.start - right.end).norm(), 1e-15);
  EXPECT_NEAR(right.end.norm(), parameters_.rim_radius, 1e-15);
  EXPECT_NEAR(right.start.norm(), parameters_.bore_radius, 1e-15);
  // At the rim, cuts move as far as the slot: their angle is the slot's shift over the radius.
  const Edge& flat = edge(plane_.disk, "cut_right");
  const double turn = std::atan2(right.end.x(), right.end.y()) - std::atan2(flat.end.x(), flat.end.y());
  EXPECT_NEAR(turn, shift_ / parameters_.rim_radius, 1e-14);
}

TEST_F(SkewedSection, IsThePlaneSectionInTheMiddleAndWithoutSkew) {
  for (const Profile& same : {section_at(plane_, parameters_, solid_, 0), section_at(plane_, parameters_, {}, z_)})
    for (std::size_t i = 0; i < plane_.disk.size(); ++i) {
      EXPECT_EQ(same.disk[i].start, plane_.disk[i].start);
      EXPECT_EQ(same.disk[i].sweep, plane_.disk[i].sweep);
    }
}

TEST(LayerEnds, AreEvenOrGradedTowardsTheEnds) {
  const std::vector<double> even = layer_ends(40e-3, 8, 1);
  for (std::size_t k = 0; k < even.size(); ++k) EXPECT_NEAR(even[k], -20e-3 + 5e-3 * static_cast<double>(k), 1e-17);
  const int many = 400;
  const std::vector<double> graded = layer_ends(40e-3, many, 0.3);
  EXPECT_EQ(graded.front(), -20e-3);
  EXPECT_EQ(graded.back(), 20e-3);
  const double outer = graded[1] - graded[0], inner = graded[many / 2 + 1] - graded[many / 2];
  // Layers of 1/200 of the parameter: slopes at their middles differ from those at the end by less than 2 %.
  EXPECT_NEAR(outer / inner, 0.3, 0.02);
  for (std::size_t k = 0; k < graded.size(); ++k) EXPECT_NEAR(graded[k], -graded[graded.size() - 1 - k], 1e-17);
}

TEST(FlankFrame, IsOrthonormalAndInTheSweptFlank) {
  for (const bool left : {true, false})
    for (const double skew : {-25 * kRadian, 0.0, 20 * kRadian}) {
      const double mirror = left ? -1 : 1, angle = 50 * kRadian;
      const Vector2d along(mirror * std::sin(angle), -std::cos(angle));
      const FlankFrame frame = flank_frame(along, left, skew);
      Eigen::Matrix3d axes;
      axes << frame.normal, frame.tangents;
      EXPECT_LE((axes.transpose() * axes - Eigen::Matrix3d::Identity()).norm(), 1e-15);
      const Vector3d flank(along.x(), along.y(), 0), slot(std::tan(skew), 0, 1);
      EXPECT_NEAR(frame.normal.dot(flank), 0, 1e-15);
      EXPECT_NEAR(frame.normal.dot(slot), 0, 1e-15);
      EXPECT_GT(frame.normal.y(), 0);  // out of the blade, which the pull presses outwards
      EXPECT_GT(mirror * frame.normal.x(), 0);
      EXPECT_GT(frame.tangents.col(0).dot(flank), 0);
      EXPECT_LE(Vector3d(frame.tangents.col(1) - slot.normalized()).norm(), 1e-15);
    }
}

}  // namespace
}  // namespace dovetail::geometry
