#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <random>
#include <vector>

#include "geometry/mesh/elastic_motion.hpp"
#include "geometry/mesh/flank_fractions.hpp"
#include "geometry/mesh/mesh_motion.hpp"

namespace dovetail::geometry {
namespace {

constexpr double kRadian = std::numbers::pi / 180;

ProfileParameters with_angle(double degrees) {
  ProfileParameters p;
  p.flank("left").angle = p.flank("right").angle = degrees * kRadian;
  return p;
}

/// Not reachable from the standard design by stretching.
ProfileParameters far_away() {
  return with_angle(69);
}

TEST(MeshFamily, GivesTheSameBitsTwice) {
  const MeshFamily first{ProfileParameters{}}, second{ProfileParameters{}};
  const MeshedSector a = first.mesh_of(with_angle(53)), b = second.mesh_of(with_angle(53));
  EXPECT_EQ(a.sector.mesh.nodes, b.sector.mesh.nodes);
  EXPECT_EQ(a.sector.mesh.connectivity, b.sector.mesh.connectivity);
}

TEST(MeshFamily, DoesNotRememberEarlierDesigns) {
  const MeshFamily family{ProfileParameters{}};
  const std::vector<ProfileParameters> designs{with_angle(47), far_away(), with_angle(53)};
  std::vector<MeshedSector> forwards;
  for (const ProfileParameters& p : designs) forwards.push_back(family.mesh_of(p));
  for (std::size_t k = designs.size(); k-- > 0;) {
    const MeshedSector again = family.mesh_of(designs[k]);
    EXPECT_EQ(again.sector.mesh.nodes, forwards[k].sector.mesh.nodes);
    EXPECT_EQ(again.sector.mesh.connectivity, forwards[k].sector.mesh.connectivity);
    EXPECT_EQ(again.remeshed, forwards[k].remeshed);
  }
}

TEST(MeshFamily, KeepsTheTopology) {
  const MeshFamily family{ProfileParameters{}};
  const MeshedSector a = family.mesh_of({}), b = family.mesh_of(with_angle(54));
  EXPECT_EQ(a.sector.mesh.connectivity, b.sector.mesh.connectivity);
  EXPECT_EQ(a.sector.cyclic_pairs, b.sector.cyclic_pairs);
  EXPECT_NE(a.sector.mesh.nodes, b.sector.mesh.nodes);
}

TEST(MeshFamily, LeavesTheMeshAloneWhenOnlyTheFlankFormChanges) {
  const MeshFamily family{ProfileParameters{}};
  ProfileParameters p;
  p.flank("right").mismatch = 15e-6;
  p.flank("left").crown = 5e-6;
  const MeshedSector a = family.mesh_of({}), b = family.mesh_of(p);
  EXPECT_EQ(a.sector.mesh.nodes, b.sector.mesh.nodes);
  EXPECT_GT(b.sector.flanks[0].gap.maxCoeff(), 0);
}

TEST(MeshFamily, MovesNodesSmoothlyAlongAParameterLine) {
  const MeshFamily family{ProfileParameters{}};
  const auto at = [&](double t) {
    ProfileParameters p;
    p.flank("left").angle = p.flank("right").angle = (46 + 8 * t) * kRadian;
    p.flank("left").length = (5 + t) * 1e-3;
    p.neck_fillet_radius = (1.6 + 0.9 * t) * 1e-3;
    return family.mesh_of(p).sector.mesh.nodes;
  };
  const auto bend = [&](double h) {
    double largest = 0;
    for (double t = h; t < 1 - h / 2; t += h) {
      const Eigen::Matrix2Xd second = at(t + h) - 2 * at(t) + at(t - h);
      largest = std::max(largest, second.cwiseAbs().maxCoeff());
    }
    return largest;
  };
  // Second differences of a smooth curve fall fourfold when the step is halved (here the curvature itself
  // varies by some per cent, hence 3.5); those of a curve with a kink fall twofold, with a jump not at all.
  const double coarse = bend(1.0 / 8), fine = bend(1.0 / 16);
  EXPECT_GT(coarse, 0);
  EXPECT_LT(fine, coarse / 3.5);
}

TEST(MeshFamily, GivesCloseMeshesToCloseDesigns) {
  const MeshFamily family{ProfileParameters{}};
  ProfileParameters p = with_angle(48);
  const Eigen::Matrix2Xd before = family.mesh_of(p).sector.mesh.nodes;
  p.neck_width += 1e-9;
  const double moved = (family.mesh_of(p).sector.mesh.nodes - before).cwiseAbs().maxCoeff();
  // The neck's sides move by half of the change, and the nodes between them no further than about that.
  EXPECT_GT(moved, 0.4e-9);
  EXPECT_LT(moved, 1e-9);
}

TEST(MeshFamily, StretchesOverTheUsualRangeWithoutMeshingAfresh) {
  ProfileParameters base;
  base.shank_width = 11e-3;  // leaves a shoulder above the widest neck
  const MeshFamily family(base);
  std::mt19937_64 random(7);
  const auto between = [&random](double a, double b) {
    return a + (b - a) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  for (int k = 0; k < 100; ++k) {
    ProfileParameters p = base;
    p.flank("left").angle = between(45, 55) * kRadian;
    p.flank("left").length = between(4.5e-3, 6.5e-3);
    p.flank("right") = p.flank("left");
    if (k % 2 == 1) {
      p.flank("right").angle = between(45, 55) * kRadian;
      p.flank("right").length = between(4.5e-3, 6.5e-3);
    }
    p.neck_width = between(7.5e-3, 9.5e-3);
    p.neck_fillet_radius = between(1.4e-3, 2.8e-3);
    p.slot_fillet_radius = between(1.4e-3, 2.8e-3);
    const MeshedSector meshed = family.mesh_of(p);
    EXPECT_FALSE(meshed.remeshed) << meshed.note;
    EXPECT_EQ(meshed.quality.inverted_elements, 0);
    EXPECT_GT(meshed.quality.minimum_scaled_jacobian, 0.3);
  }
}

TEST(MeshFamily, MeshesAfreshAndSaysSoWhereTheReferenceDoesNotReach) {
  const MeshFamily family{ProfileParameters{}};
  const MeshedSector meshed = family.mesh_of(far_away());
  EXPECT_TRUE(meshed.remeshed);
  EXPECT_THAT(meshed.note, ::testing::HasSubstr("meshed afresh"));
  EXPECT_TRUE(acceptable(meshed.quality, MeshLimits{}));
  EXPECT_EQ(meshed.sector.mesh.nodes, mesh_sector(far_away()).sector.mesh.nodes);
}

TEST(MeshFamily, SaysWhenADesignCannotBeMeshed) {
  const MeshFamily family{ProfileParameters{}};
  ProfileParameters p;
  p.flank("left").length = p.flank("right").length = 25e-3;  // the slot reaches beyond the cuts
  const MeshedSector meshed = family.mesh_of(p);
  EXPECT_GT(meshed.quality.inverted_elements, 0);
  EXPECT_FALSE(meshed.remeshed);
  EXPECT_THAT(meshed.note, ::testing::HasSubstr("cannot be meshed afresh"));
}

TEST(ElasticMotion, ReproducesRigidDisplacements) {
  const Profile profile = build_profile({});
  const CornerMesh disk = mesh_corners(profile.disk, {}, flank_fractions({}, {}));
  const Prescribed boundary = prescribed_nodes(disk, profile.disk);
  const ElasticMotion motion(disk, boundary.nodes);
  Eigen::Matrix2d turn;  // linearised rotation: no strain
  turn << 1, 0.1, -0.1, 1;
  const Eigen::Vector2d shift(1e-3, -2e-3);
  const Eigen::Matrix2Xd moved = motion.positions((turn * boundary.positions).colwise() + shift);
  double largest = 0;
  for (std::size_t k = 0; k < disk.nodes.size(); ++k)
    largest = std::max(largest, (moved.col(static_cast<Eigen::Index>(k)) - turn * disk.nodes[k] - shift).norm());
  // Rounding of the solve: condition some 1e4 times 1e-16 times displacements of 25 mm.
  EXPECT_LE(largest, 1e-13);
}

}  // namespace
}  // namespace dovetail::geometry
