#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <numbers>
#include <ostream>
#include <set>

#include "core/errors.hpp"
#include "geometry/mesh/flank_fractions.hpp"
#include "geometry/mesh/mesh_motion.hpp"
#include "geometry/profile/fillet_share.hpp"
#include "geometry/profile/flank_form.hpp"
#include "mesh_checks.hpp"

namespace dovetail::geometry {
namespace {

using Eigen::Vector2d;
constexpr double kDegree = std::numbers::pi / 180;

ProfileParameters lopsided() {
  ProfileParameters p;
  p.flank("left").angle = 47 * kDegree;
  p.flank("right").angle = 53 * kDegree;
  p.flank("left").length = 5.0e-3;
  p.flank("right").length = 6.0e-3;
  return p;
}

ProfileParameters rounded(double radius) {
  ProfileParameters p;
  p.flank("left").edge_radius = p.flank("right").edge_radius = radius;
  return p;
}

/// Every check of the mesh itself is run on a symmetric and a lopsided design, coarse and fine, and on rounded flanks.
struct Case {
  const char* name;
  ProfileParameters parameters;
  MeshSizes sizes;

  friend void PrintTo(const Case& given, std::ostream* out) { *out << given.name; }
};

class SectorMeshOf : public ::testing::TestWithParam<Case> {
 protected:
  Profile profile_ = build_profile(GetParam().parameters);
  MeshedSector meshed_ = mesh_sector(GetParam().parameters, GetParam().sizes);
  const fem::Mesh& mesh_ = meshed_.sector.mesh;
};

INSTANTIATE_TEST_SUITE_P(
    Designs, SectorMeshOf,
    ::testing::Values(
        Case{"standard", {}, {}}, Case{"lopsided", lopsided(), {}},
        Case{"coarse", {}, {.flank_elements = 6, .fillet_fraction = 0.3, .bulk_size = 6e-3, .aerofoil_elements = 16}},
        Case{"fine", lopsided(), {.flank_elements = 48, .fillet_fraction = 0.07, .bulk_size = 2.5e-3}},
        Case{"equal", {}, {.flank_grading = 1}}, Case{"rounded", rounded(20e-3), {.flank_elements = 64}},
        Case{"few_rounded", rounded(1e-3), {}}),
    [](const auto& given) { return given.param.name; });

TEST_P(SectorMeshOf, HasWellShapedElements) {
  EXPECT_EQ(meshed_.quality.inverted_elements, 0);
  EXPECT_GT(meshed_.quality.minimum_scaled_jacobian, 0.3);
  EXPECT_GT(meshed_.quality.minimum_angle, 15 * kDegree);
  EXPECT_LT(meshed_.quality.maximum_angle, 140 * kDegree);
  EXPECT_FALSE(meshed_.remeshed);
}

TEST_P(SectorMeshOf, CoversTheExactSection) {
  // The parabola through the ends and the middle of an arc of angle t misses the area of the circular segment by
  // R^2 t^5 / 960; with chord c and rise s, R = c^2 / (8 s) and t = c / R, that is (8/15) s^3 / c. Ten per cent
  // cover the terms of higher order. The disk's area of 5e-3 m^2 rounds to about 1e-17.
  std::array<double, 2> tolerance{1e-16, 1e-16};
  std::set<int> in_disk;
  for (int e = 0; e < mesh_.element_count(); ++e)
    if (mesh_.region[static_cast<std::size_t>(e)] == 2)
      in_disk.insert(mesh_.element(e).begin(), mesh_.element(e).end());
  for (const auto& [side, use] : sides(mesh_)) {
    const Vector2d from = mesh_.nodes.col(side.first), to = mesh_.nodes.col(side.second);
    const double rise = (mesh_.nodes.col(use.middle) - (from + to) / 2).norm();
    const std::size_t body = in_disk.contains(side.first) ? 1 : 0;
    tolerance[body] += 1.1 * 8 / 15 * std::pow(rise, 3) / (to - from).norm();
  }
  EXPECT_NEAR(mesh_area(mesh_, 0), exact_area(profile_.blade), tolerance[0]);
  EXPECT_NEAR(mesh_area(mesh_, 1), exact_area(profile_.disk), tolerance[1]);
  EXPECT_LT(tolerance[0], 1e-5 * exact_area(profile_.blade));
  EXPECT_LT(tolerance[1], 1e-5 * exact_area(profile_.disk));
}

TEST_P(SectorMeshOf, IsConformingAndClosed) {
  std::map<int, int> boundary_sides_at;
  std::set<int> used;
  for (const auto& [side, use] : sides(mesh_)) {
    ASSERT_TRUE(use.count == 1 || use.count == 2);
    EXPECT_TRUE(use.one_middle);
    used.insert({side.first, side.second, use.middle});
    if (use.count == 1) {
      ++boundary_sides_at[side.first];
      ++boundary_sides_at[side.second];
    }
  }
  for (const auto& [node, count] : boundary_sides_at) EXPECT_EQ(count, 2) << "node " << node;
  EXPECT_EQ(used.size(), static_cast<std::size_t>(mesh_.node_count()));
}

TEST_P(SectorMeshOf, MatchesTheFlanksInPairs) {
  const fem::SectorMesh& sector = meshed_.sector;
  ASSERT_EQ(sector.flanks.size(), 2u);
  EXPECT_EQ(sector.flanks[0].name, "left");
  EXPECT_EQ(sector.flanks[1].name, "right");
  for (const fem::Flank& flank : sector.flanks) {
    const bool left = flank.name == "left";
    const FlankParameters& p = GetParam().parameters.flank(flank.name);
    const int parts = GetParam().sizes.flank_elements;
    const std::vector<double> fractions = with_middles(flank_fractions(GetParam().parameters, GetParam().sizes));
    ASSERT_EQ(flank.pairs.size(), static_cast<std::size_t>(2 * parts + 1));
    ASSERT_EQ(flank.grid, (std::array<int, 2>{parts + 1, 1}));
    const Vector2d neck = mesh_.nodes.col(flank.pairs.front()[0]);
    const double mirror = left ? -1 : 1;
    const Vector2d tangent = flank.tangents.col(0);
    // Positions are sums of a few numbers up to 0.25 m: some 1e-16 m of rounding; directions over 5 mm: 1e-13.
    EXPECT_NEAR(tangent.x(), mirror * std::sin(p.angle), 1e-12);
    EXPECT_NEAR(tangent.y(), -std::cos(p.angle), 1e-12);
    EXPECT_NEAR(flank.normal[0], mirror * std::cos(p.angle), 1e-12);
    EXPECT_NEAR(flank.normal[1], std::sin(p.angle), 1e-12);
    for (std::size_t k = 0; k < flank.pairs.size(); ++k) {
      const double s = fractions[k];
      const auto& [blade, disk] = flank.pairs[k];
      EXPECT_LE((mesh_.nodes.col(blade) - mesh_.nodes.col(disk)).norm(), 1e-15);
      EXPECT_NE(blade, disk);
      EXPECT_LE((mesh_.nodes.col(blade) - neck - s * p.length * tangent).norm(), 1e-15);
      if (k % 2 == 0) {
        EXPECT_EQ(flank.position.col(static_cast<Eigen::Index>(k / 2)), mesh_.nodes.col(blade));
      }
    }
    // Linear interpolation gives every pair's place from those of the contact nodes, up to rounding.
    const Eigen::MatrixXd places = flank.position * flank.interpolation.transpose();
    for (std::size_t k = 0; k < flank.pairs.size(); ++k) {
      const Vector2d place = places.col(static_cast<Eigen::Index>(k));
      EXPECT_LE((place - mesh_.nodes.col(flank.pairs[k][0])).norm(), 1e-15);
    }
  }
}

TEST_P(SectorMeshOf, HasCutsThatAreRotationsOfEachOther) {
  const Eigen::Rotation2D<double> turn(-2 * std::numbers::pi / GetParam().parameters.sectors);
  EXPECT_EQ(meshed_.sector.sectors, GetParam().parameters.sectors);
  ASSERT_GE(meshed_.sector.cyclic_pairs.size(), 3u);
  for (const auto& [left, right] : meshed_.sector.cyclic_pairs) {
    EXPECT_LT(mesh_.nodes(0, left), 0);
    EXPECT_LE((turn * mesh_.nodes.col(left) - mesh_.nodes.col(right)).norm(), 1e-15);
  }
}

TEST_P(SectorMeshOf, KeepsMiddleNodesOnTheArcs) {
  const auto on = [&](const std::vector<int>& nodes, const Edge& first, const Edge& second) {
    ASSERT_GE(nodes.size(), 3u);
    for (int node : nodes) {
      const Vector2d x = mesh_.nodes.col(node);
      const double off = std::min(std::abs((x - first.center).norm() - first.radius),
                                  std::abs((x - second.center).norm() - second.radius));
      EXPECT_LE(off, 1e-15) << first.name;
    }
  };
  const Edge& bore = edge(profile_.disk, "bore");
  on(meshed_.sector.bore_nodes, bore, bore);
  on(meshed_.sector.blade_fillet_nodes, edge(profile_.blade, "neck_fillet_left"),
     edge(profile_.blade, "neck_fillet_right"));
  on(meshed_.sector.disk_fillet_nodes, edge(profile_.disk, "slot_fillet_left"),
     edge(profile_.disk, "slot_fillet_right"));
}

TEST_P(SectorMeshOf, LeavesTheFlanksEndsOutOfTheFillets) {
  const fem::SectorMesh& sector = meshed_.sector;
  const auto shares = [&](const std::vector<int>& nodes, const Eigen::VectorXd& share, const char* fillet,
                          const char* flank) {
    ASSERT_EQ(share.size(), static_cast<Eigen::Index>(nodes.size()));
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const Vector2d x = mesh_.nodes.col(nodes[k]);
      const std::string side = x.x() < 0 ? "_left" : "_right";
      const Chain& chain = std::string(fillet) == "neck_fillet" ? profile_.blade : profile_.disk;
      const double radius = edge(chain, fillet + side).radius;
      const Edge& on = edge(chain, flank + side);
      const double away = std::min((x - on.start).norm(), (x - on.end).norm()) / radius;
      // Along the arc it is a little further than straight.
      const double value = share[static_cast<Eigen::Index>(k)];
      if (away < 0.99 * FilletShareParams{}.from) {
        EXPECT_EQ(value, 0) << fillet << " " << away;
      }
      if (away > FilletShareParams{}.to) {
        EXPECT_EQ(value, 1) << fillet << " " << away;
      }
    }
    EXPECT_EQ(share.maxCoeff(), 1);
  };
  shares(sector.blade_fillet_nodes, sector.blade_fillet_share, "neck_fillet", "flank");
  shares(sector.disk_fillet_nodes, sector.disk_fillet_share, "slot_fillet", "flank");
  EXPECT_EQ(sector.blade_fillet_share.minCoeff(), 0);
}

TEST(FilletShare, RisesSmoothlyFromNoneToAll) {
  EXPECT_EQ(fillet_share(0), 0);
  EXPECT_EQ(fillet_share(FilletShareParams{}.from), 0);
  EXPECT_NEAR(fillet_share((FilletShareParams{}.from + FilletShareParams{}.to) / 2), 0.5, 1e-15);
  EXPECT_EQ(fillet_share(FilletShareParams{}.to), 1);
  EXPECT_EQ(fillet_share(1), 1);
  // A cubic with level ends: next to them it moves with the square of the distance, 3 t^2.
  const double t = 1e-3;
  EXPECT_NEAR(fillet_share(FilletShareParams{}.from + t * (FilletShareParams{}.to - FilletShareParams{}.from)),
              3 * t * t, 3 * t * t * t);
  EXPECT_NEAR(1 - fillet_share(FilletShareParams{}.to - t * (FilletShareParams{}.to - FilletShareParams{}.from)),
              3 * t * t, 3 * t * t * t);
}

TEST_P(SectorMeshOf, NamesTheTipAndTheNeck) {
  const Edge& tip = edge(profile_.blade, "tip");
  EXPECT_LE((mesh_.nodes.col(meshed_.sector.tip_node) - (tip.start + tip.end) / 2).norm(), 1e-15);
  ASSERT_EQ(meshed_.sector.neck_nodes.size(), 4u);
  const std::array<Vector2d, 4> expected{
      edge(profile_.blade, "neck_fillet_left").end, edge(profile_.blade, "neck_fillet_right").start,
      edge(profile_.blade, "neck_fillet_left").start, edge(profile_.blade, "neck_fillet_right").end};
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_EQ(Vector2d(mesh_.nodes.col(meshed_.sector.neck_nodes[k])), expected[k]) << k;
  EXPECT_LT(expected[0].y(), expected[2].y());
}

TEST_P(SectorMeshOf, SeparatesTheRegions) {
  ASSERT_EQ(mesh_.regions.size(), 3u);
  EXPECT_EQ(mesh_.regions[0].name, "blade_root");
  EXPECT_EQ(mesh_.regions[1].name, "aerofoil");
  EXPECT_EQ(mesh_.regions[2].name, "disk");
  EXPECT_EQ(mesh_.regions[1].body, 0);
  EXPECT_EQ(mesh_.regions[2].body, 1);
  const double foot = edge(profile_.blade, "aerofoil_right").start.y();
  for (int e = 0; e < mesh_.element_count(); ++e) {
    const int region = mesh_.region[static_cast<std::size_t>(e)];
    for (int node : mesh_.element(e)) {
      const double above = mesh_.nodes(1, node) - foot;
      if (region == 1) {
        EXPECT_GE(above, -1e-15);
      } else {
        EXPECT_LE(above, 1e-15);
      }
    }
  }
}

TEST(SectorMesh, HasTheIntendedSizeByDefault) {
  const MeshedSector meshed = mesh_sector({});
  EXPECT_GE(meshed.sector.mesh.node_count(), 6000);
  EXPECT_LE(meshed.sector.mesh.node_count(), 9000);
}

TEST(SectorMesh, TakesThicknessesFromTheDesign) {
  ProfileParameters p;
  p.chord = 35e-3;
  p.slot_length = 42e-3;
  const MeshedSector meshed = mesh_sector(p);
  EXPECT_EQ(meshed.sector.mesh.regions[0].thickness, 42e-3);
  EXPECT_EQ(meshed.sector.mesh.regions[1].thickness, 35e-3);
  EXPECT_EQ(meshed.sector.mesh.regions[2].thickness, 42e-3);
}

TEST(SectorMesh, OfASymmetricDesignIsItsOwnMirrorImage) {
  const MeshedSector meshed = mesh_sector({});
  const Eigen::Matrix2Xd& nodes = meshed.sector.mesh.nodes;
  // Positions are good to about 1e-15 m and nodes are more than 1e-5 m apart: places rounded to 1e-9 m and
  // their neighbours identify them.
  std::set<std::pair<long, long>> places;
  const auto key = [](double x, double y) { return std::pair{std::lround(x / 1e-9), std::lround(y / 1e-9)}; };
  for (const auto& x : nodes.colwise()) places.insert(key(x.x(), x.y()));
  for (const auto& x : nodes.colwise()) {
    bool found = false;
    for (long i : {-1, 0, 1})
      for (long j : {-1, 0, 1}) {
        const auto [a, b] = key(-x.x(), x.y());
        found = found || places.contains({a + i, b + j});
      }
    EXPECT_TRUE(found) << x.transpose();
  }
}

TEST(SectorMesh, CarriesTheGapOfTheFlankForm) {
  ProfileParameters p;
  p.flank("right").mismatch = 20e-6;
  p.flank("left").mismatch = -10e-6;
  const MeshedSector meshed = mesh_sector(p);
  const Eigen::VectorXd &left = meshed.sector.flanks[0].gap, &right = meshed.sector.flanks[1].gap;
  const Eigen::Index last = right.size() - 1;
  const std::vector<double> fractions = flank_fractions(p, {});
  for (Eigen::Index k = 0; k <= last; ++k) {
    const double s = fractions[static_cast<std::size_t>(k)];
    EXPECT_NEAR(right[k], 20e-6 * s, 1e-18);
    EXPECT_NEAR(left[k], 10e-6 * (1 - s), 1e-18);
  }
}

TEST(SectorMesh, RefusesSizesOutOfRange) {
  EXPECT_THROW((void)mesh_sector({}, {.flank_elements = 0}), InputError);
  EXPECT_THROW((void)mesh_sector({}, {.bulk_size = -1}), InputError);
}

TEST(SectorMesh, RefusesABoundaryThatCrossesItself) {
  ProfileParameters p;
  p.flank("left").length = p.flank("right").length = 25e-3;  // the slot reaches beyond the cuts
  try {
    (void)mesh_sector(p);
    FAIL() << "no exception";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("must not cross or touch itself"));
  }
}

}  // namespace
}  // namespace dovetail::geometry
