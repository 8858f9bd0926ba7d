#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <map>
#include <numbers>
#include <ostream>
#include <set>

#include "fem/element.hpp"
#include "geometry/mesh/flank_fractions.hpp"
#include "geometry/rules/solid_rules.hpp"
#include "geometry/solid/solid_flank.hpp"
#include "geometry/solid/solid_measures.hpp"
#include "tests/unit/geometry/solid_checks.hpp"

namespace dovetail::geometry {
namespace {

using Eigen::Vector3d;

struct Case {
  const char* name;
  SolidParameters solid;
  SolidSizes sizes;

  friend void PrintTo(const Case& given, std::ostream* out) { *out << given.name; }
};

/// Every check of the mesh itself is run on all of these.
class SolidMeshOf : public ::testing::TestWithParam<Case> {
 protected:
  static ProfileParameters parameters() {
    ProfileParameters p;
    p.flank("left").angle = 48 * kRadian;
    p.flank("right").length = 6e-3;
    p.flank("right").mismatch = 10e-6;
    return p;
  }
  MeshedSector meshed_ = mesh_solid(parameters(), GetParam().solid, coarse_section(), GetParam().sizes);
  const fem::SectorMesh& sector_ = meshed_.sector;
  const fem::Mesh& mesh_ = sector_.mesh;
  MeshedSector plane_ = mesh_sector(parameters(), coarse_section());

  [[nodiscard]] Vector3d at(int node) const { return mesh_.nodes.col(node); }
};

INSTANTIATE_TEST_SUITE_P(
    Designs, SolidMeshOf,
    ::testing::Values(
        Case{"extruded", {}, {.slot_elements = 3}},
        Case{"skewed", {.skew_angle = -20 * kRadian}, {.slot_elements = 4, .slot_grading = 0.4}},
        Case{"everything",
             everything(),
             {.slot_elements = 5, .slot_grading = 0.5, .contact_flank_elements = 3, .contact_slot_elements = 4}}),
    [](const auto& given) { return given.param.name; });

TEST_P(SolidMeshOf, HasNoInvertedElements) {
  EXPECT_EQ(meshed_.quality.inverted_elements, 0);
  EXPECT_GT(meshed_.quality.minimum_scaled_jacobian, 0.1) << meshed_.note;
  EXPECT_FALSE(meshed_.remeshed);
}

TEST_P(SolidMeshOf, RepeatsThePlaneTopology) {
  const int layers = GetParam().sizes.slot_elements, nodes = plane_.sector.mesh.node_count();
  EXPECT_EQ(mesh_.kind, fem::ElementKind::wedge18);
  EXPECT_EQ(mesh_.node_count(), nodes * (2 * layers + 1));
  EXPECT_EQ(mesh_.element_count(), plane_.sector.mesh.element_count() * layers);
  // Every nine-node side is used once or twice, by the same nine nodes.
  std::map<std::set<int>, int> sides;
  for (int e = 0; e < mesh_.element_count(); ++e)
    for (const auto& side : fem::Wedge18::sides()) {
      std::set<int> key;
      for (const int i : side) key.insert(mesh_.element(e)[static_cast<std::size_t>(i)]);
      ASSERT_EQ(key.size(), 9u);
      ++sides[key];
    }
  for (const auto& [side, uses] : sides) EXPECT_LE(uses, 2);
}

TEST_P(SolidMeshOf, IsThePlaneMeshInTheMiddle) {
  const int layers = GetParam().sizes.slot_elements;
  const fem::Mesh& plane = plane_.sector.mesh;
  const int first = plane.node_count() * layers;
  // The aerofoil turns; below the elements that reach above the neck the middle of the slot is the section itself.
  const double neck = edge(build_profile(parameters()).blade, "neck_right").start.y();
  for (int i = 0; i < plane.node_count(); ++i) {
    if (plane.nodes(1, i) > neck) continue;
    const Vector3d flat(plane.nodes(0, i), plane.nodes(1, i), 0);
    EXPECT_LE((at(first + i) - flat).norm(), 1e-15);
  }
}

TEST_P(SolidMeshOf, MatchesTheFlanksNodeByNode) {
  for (const fem::Flank& flank : sector_.flanks) {
    const std::size_t width = 2 * static_cast<std::size_t>(coarse_section().flank_elements) + 1;
    ASSERT_EQ(flank.pairs.size(), width * static_cast<std::size_t>(2 * GetParam().sizes.slot_elements + 1));
    for (const auto& [blade, disk] : flank.pairs) {
      EXPECT_NE(blade, disk);
      EXPECT_EQ(at(blade), at(disk));
    }
  }
}

TEST_P(SolidMeshOf, HasPlaneFlanksAlongTheirDirections) {
  const Vector3d slot(std::sin(GetParam().solid.skew_angle), 0, std::cos(GetParam().solid.skew_angle));
  for (const fem::Flank& flank : sector_.flanks) {
    const Vector3d normal = flank.normal, first = flank.tangents.col(0), second = flank.tangents.col(1);
    EXPECT_LE((second - slot).norm(), 1e-15);
    EXPECT_NEAR(normal.norm(), 1, 1e-15);
    EXPECT_NEAR(normal.dot(first), 0, 1e-15);
    EXPECT_NEAR(normal.dot(second), 0, 1e-15);
    EXPECT_NEAR(first.dot(second), 0, 1e-15);
    EXPECT_GT(normal.y(), 0);
    const Vector3d corner = at(flank.pairs.front()[0]);
    // Places up to 0.25 m, rounded to 5e-17 each.
    for (const auto& [blade, disk] : flank.pairs) EXPECT_NEAR(normal.dot(at(blade) - corner), 0, 1e-15);
    EXPECT_GT(first.dot(at(flank.pairs.back()[0]) - corner), 0);
  }
}

TEST_P(SolidMeshOf, InterpolatesBetweenContactNodes) {
  const SolidSizes& sizes = GetParam().sizes;
  const auto count = [](int contact, int mesh) { return (contact > 0 ? contact : mesh) + 1; };
  for (const fem::Flank& flank : sector_.flanks) {
    EXPECT_EQ(flank.grid[0], count(sizes.contact_flank_elements, coarse_section().flank_elements));
    EXPECT_EQ(flank.grid[1], count(sizes.contact_slot_elements, sizes.slot_elements));
    ASSERT_EQ(flank.interpolation.rows(), static_cast<Eigen::Index>(flank.pairs.size()));
    ASSERT_EQ(flank.interpolation.cols(), flank.contact_count());
    // The flank is a parallelogram: bilinear interpolation gives the place of every pair.
    const Eigen::Matrix3Xd places = flank.position * flank.interpolation.transpose();
    const Eigen::VectorXd sums = flank.interpolation * Eigen::VectorXd::Ones(flank.contact_count());
    for (std::size_t k = 0; k < flank.pairs.size(); ++k) {
      EXPECT_LE((places.col(static_cast<Eigen::Index>(k)) - at(flank.pairs[k][0])).norm(), 1e-15);
      EXPECT_NEAR(sums[static_cast<Eigen::Index>(k)], 1, 1e-15);
    }
    EXPECT_GE(Eigen::VectorXd(flank.interpolation.coeffs()).minCoeff(), 0);
  }
}

TEST_P(SolidMeshOf, CarriesTheGapOverTheFlank) {
  const ProfileParameters p = parameters();
  for (const fem::Flank& flank : sector_.flanks) {
    const std::vector<double> across = divided_like(flank_fractions(p, coarse_section()), flank.grid[0] - 1);
    const SolidFlankForm form(p.flank(flank.name), p, GetParam().solid);
    ASSERT_EQ(flank.gap.size(), flank.contact_count());
    for (int j = 0; j < flank.grid[1]; ++j)
      for (int i = 0; i < flank.grid[0]; ++i) {
        const int node = i + flank.grid[0] * j;
        EXPECT_NEAR(flank.gap[node],
                    form.gap(across[static_cast<std::size_t>(i)], flank.position(2, node) / p.slot_length + 0.5),
                    1e-19);
      }
  }
}

TEST_P(SolidMeshOf, HasCutsThatAreRotationsOfEachOther) {
  const Eigen::AngleAxisd turn(-2 * std::numbers::pi / sector_.sectors, Vector3d::UnitZ());
  ASSERT_EQ(sector_.cyclic_pairs.size(),
            plane_.sector.cyclic_pairs.size() * static_cast<std::size_t>(2 * GetParam().sizes.slot_elements + 1));
  for (const auto& [left, right] : sector_.cyclic_pairs) EXPECT_LE((turn * at(left) - at(right)).norm(), 1e-15);
}

TEST_P(SolidMeshOf, KeepsTheBoreOnItsCylinderAndTheRootInItsSlot) {
  const ProfileParameters p = parameters();
  for (const int node : sector_.bore_nodes) EXPECT_NEAR(at(node).head<2>().norm(), p.bore_radius, 1e-15);
  const Profile section = build_profile(p);
  const Edge &left = edge(section.blade, "neck_fillet_left"), &right = edge(section.blade, "neck_fillet_right");
  for (const int node : sector_.blade_fillet_nodes) {
    const Eigen::Vector2d in_section(at(node).x() - at(node).z() * std::tan(GetParam().solid.skew_angle), at(node).y());
    const double off = std::min(std::abs((in_section - left.center).norm() - left.radius),
                                std::abs((in_section - right.center).norm() - right.radius));
    EXPECT_LE(off, 1e-15);
  }
}

TEST_P(SolidMeshOf, NamesTheNodesOfTheMiddle) {
  const Edge tip = edge(build_profile(parameters()).blade, "tip");
  EXPECT_LE((at(sector_.tip_node) - Vector3d(GetParam().solid.lean, tip.start.y(), 0)).norm(), 1e-15);
  ASSERT_EQ(sector_.neck_nodes.size(), 4u);
  for (const int node : sector_.neck_nodes) EXPECT_EQ(at(node).z(), 0);
  EXPECT_EQ(sector_.axial_nodes, sector_.bore_nodes);
}

TEST(SolidMesh, IsTheExtrudedPlaneMeshWithoutAngles) {
  const MeshedSector plane = mesh_sector({}, coarse_section()), solid = mesh_solid({}, {}, coarse_section());
  const Eigen::Index count = plane.sector.mesh.nodes.cols();
  const Eigen::MatrixXd& nodes = solid.sector.mesh.nodes;
  for (Eigen::Index i = 0; i < nodes.cols(); ++i) {
    const double z = -20e-3 + 2.5e-3 * static_cast<double>(i / count);
    const Vector3d flat(plane.sector.mesh.nodes(0, i % count), plane.sector.mesh.nodes(1, i % count), z);
    EXPECT_LE((nodes.col(i) - flat).norm(), 1e-14);
  }
  // The same shape along z: the wedges are as good as the triangles.
  EXPECT_NEAR(solid.quality.minimum_scaled_jacobian, plane.quality.minimum_scaled_jacobian, 1e-9);
}

TEST(SolidMesh, EnclosesTheVolumeOfTheParts) {
  const ProfileParameters p;
  struct Expectation {
    SolidParameters solid;
    double aerofoil, root;  // relative tolerances
  };
  // Plates and tapers are quadratic in every element: exact. A turn by d from node to node of an element is followed
  // by its quadratic interpolation up to (d/2)^3/(9 sqrt 3) of the chord (20 degrees over 16 half elements:
  // d = 0.022, 1e-7), ten times that for the variation of several columns.
  for (const Expectation& given :
       {Expectation{{}, 1e-12, 2e-4}, Expectation{{.tip_chord = 25e-3}, 1e-12, 2e-4},
        Expectation{{.skew_angle = 20 * kRadian, .stagger = 20 * kRadian, .edge_thickness_fraction = 0.3}, 1e-12, 0.05},
        Expectation{
            {.twist = 20 * kRadian, .tip_chord = 30e-3, .lean = 4e-3, .edge_thickness_fraction = 0.6}, 1e-6, 0.01}}) {
    const MeshedSector meshed = mesh_solid(p, given.solid, coarse_section());
    const SolidVolumes volumes = solid_volumes(p, given.solid);
    EXPECT_NEAR(region_volume(meshed.sector.mesh, 1) / volumes.aerofoil, 1, given.aerofoil);
    // Arcs are followed by parabolas, the section's turn along z by them too: 1e-5 as in the plane.
    EXPECT_NEAR(region_volume(meshed.sector.mesh, 2) / volumes.disk, 1, 1e-5);
    // One parabola for a blend of 1 mm misses R^2 t^5 / 960 = 0.01 mm^2, eight of them 2e-4 of the root's 400 mm^2.
    // The platform's morph changes the rest: by as much as its end faces give way, and the blends get thinner.
    EXPECT_NEAR(region_volume(meshed.sector.mesh, 0) / volumes.root, 1, given.root);
  }
}

TEST(SolidMesh, PassesFromRootToAerofoilWithoutAGap) {
  // The aerofoil's foot is where the closed form says, in a design other than the reference.
  const SolidFamily family({}, coarse_section());
  ProfileParameters p;
  p.chord = 36e-3;
  p.blend_radius = 1.3e-3;
  const SolidParameters solid = everything();
  const MeshedSector meshed = family.mesh_of(p, solid);
  const fem::Mesh& mesh = meshed.sector.mesh;
  std::set<int> aerofoil, below;
  for (int e = 0; e < mesh.element_count(); ++e)
    for (const int node : mesh.element(e)) (mesh.region_of(e).name == "aerofoil" ? aerofoil : below).insert(node);
  const Edge side = edge(build_profile(p).blade, "aerofoil_right");
  int seen = 0;
  for (const int node : aerofoil) {
    if (!below.contains(node)) continue;
    ++seen;
    EXPECT_NEAR(mesh.nodes(1, node), side.start.y(), 1e-15);
    const double c = std::cos(solid.stagger), s = std::sin(solid.stagger);
    const double along = mesh.nodes(0, node) * s + mesh.nodes(2, node) * c;
    const double across = mesh.nodes(0, node) * c - mesh.nodes(2, node) * s;
    const double eta = 2 * along / p.chord, full = 1 - (1 - solid.edge_thickness_fraction) * eta * eta;
    EXPECT_LE(std::abs(eta), 1 + 1e-12);
    const double xi = std::abs(across) / full / side.start.x();  // 0, 1/2 or 1
    EXPECT_NEAR(2 * xi, std::round(2 * xi), 1e-11);
  }
  EXPECT_EQ(seen, 5 * 17);
}

TEST(SolidMesh, ReachesSixtyThousandDegreesOfFreedom) {
  const MeshedSector meshed = mesh_solid({}, {},
                                         {.flank_elements = 6,
                                          .fillet_fraction = 0.5,
                                          .bulk_size = 10e-3,
                                          .aerofoil_elements = 10,
                                          .blend_fraction = 0.8,
                                          .growth = 0.4});
  EXPECT_GE(3 * meshed.sector.mesh.node_count(), 60000);
  EXPECT_LE(3 * meshed.sector.mesh.node_count(), 70000);
  EXPECT_EQ(2 * meshed.sector.flanks[0].contact_count(), 126);
  EXPECT_GT(meshed.quality.minimum_scaled_jacobian, 0.3);
}

}  // namespace
}  // namespace dovetail::geometry
