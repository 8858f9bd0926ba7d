#include "geometry/solid/solid_family.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>

#include "geometry/rules/solid_rules.hpp"
#include "tests/unit/geometry/random_design.hpp"
#include "tests/unit/geometry/solid_checks.hpp"

namespace dovetail::geometry {
namespace {

const SolidSizes kFewLayers{.slot_elements = 2, .slot_grading = 0.6};

struct Design {
  ProfileParameters section;
  SolidParameters solid = everything();
};

/// Moves one parameter of a design by a fraction of its value.
using Move = std::function<void(Design&, double)>;

std::vector<std::pair<std::string, Move>> moves() {
  std::vector<std::pair<std::string, Move>> list;
  for (const auto& field : option_table<ProfileParameters>())
    if (const auto* member = std::get_if<double ProfileParameters::*>(&field.member))
      list.emplace_back(field.key, [m = *member](Design& d, double by) { d.section.*m *= 1 + by; });
  for (const auto& field : option_table<FlankParameters>())
    if (const auto* member = std::get_if<double FlankParameters::*>(&field.member))
      list.emplace_back(field.key, [m = *member](Design& d, double by) { d.section.flank("right").*m *= 1 + by; });
  for (const auto& field : option_table<SolidParameters>())
    if (const auto* member = std::get_if<double SolidParameters::*>(&field.member))
      list.emplace_back(field.key, [m = *member](Design& d, double by) { d.solid.*m *= 1 + by; });
  return list;
}

TEST(SolidFamily, MovesNodesSmoothlyAlongEveryParameter) {
  const SolidFamily family({}, coarse_section(), kFewLayers);
  int moving = 0;
  for (const auto& [key, move] : moves()) {
    const auto at = [&](double t) -> Eigen::MatrixXd {
      Design design;
      move(design, 0.04 * t);
      const MeshedSector meshed = family.mesh_of(design.section, design.solid);
      EXPECT_FALSE(meshed.remeshed) << key;
      return meshed.sector.mesh.nodes;
    };
    const auto bend = [&](double h) {
      double largest = 0;
      Eigen::MatrixXd before = at(-1), here = at(-1 + h);
      for (double t = -1 + h; t < 1 - h / 2; t += h) {
        Eigen::MatrixXd after = at(t + h);
        const Eigen::MatrixXd second = after - 2 * here + before;
        largest = std::max(largest, second.cwiseAbs().maxCoeff());
        before = std::move(here);
        here = std::move(after);
      }
      return largest;
    };
    // Second differences of a smooth curve fall fourfold when the step is halved, of one with a kink twofold. Linear
    // ones are rounding: three positions up to 0.4 m and the solution of the elastic motion, some 1e-15 m.
    const double coarse = bend(1.0 / 2), fine = bend(1.0 / 4);
    EXPECT_LT(fine, std::max(coarse / 3.5, 1e-14)) << key;
    moving += coarse > 1e-14 ? 1 : 0;
  }
  EXPECT_GE(moving, 10);
}

TEST(SolidFamily, GivesTheSameBitsInAnyOrder) {
  const SolidFamily family({}, coarse_section(), kFewLayers);
  Design other;
  other.section.neck_width *= 1.05;
  other.solid.skew_angle *= -1;
  other.solid.stagger *= -1;
  const MeshedSector first = family.mesh_of({}, everything());
  const MeshedSector between = family.mesh_of(other.section, other.solid);
  const MeshedSector again = family.mesh_of({}, everything());
  EXPECT_EQ(first.sector.mesh.nodes, again.sector.mesh.nodes);
  EXPECT_NE(first.sector.mesh.nodes, between.sector.mesh.nodes);
  EXPECT_EQ(first.sector.mesh.connectivity, between.sector.mesh.connectivity);
}

TEST(SolidFamily, MeshesAfreshWhereThePlaneFamilyDoes) {
  const SolidFamily family({}, coarse_section(), kFewLayers);
  ProfileParameters p;
  p.flank("left").angle = p.flank("right").angle = 69 * kRadian;
  const MeshedSector solid = family.mesh_of(p, {});
  const MeshedSector plane = MeshFamily({}, coarse_section()).mesh_of(p);
  EXPECT_TRUE(solid.remeshed);
  EXPECT_EQ(solid.remeshed, plane.remeshed);
  EXPECT_EQ(solid.quality.inverted_elements, 0);
  EXPECT_EQ(solid.sector.mesh.nodes, mesh_solid(p, {}, coarse_section(), kFewLayers).sector.mesh.nodes);
}

TEST(SolidFamily, HasNoInvertedElementsOverFeasibleDesigns) {
  ProfileParameters base;
  const SolidFamily family(base, coarse_section(), kFewLayers);
  std::mt19937 generator(5);
  const auto between = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(generator); };
  int feasible = 0;
  for (int trial = 0; trial < 400; ++trial) {
    ProfileParameters p = random_design(generator, 0.08);
    p.sectors = base.sectors;
    const SolidParameters solid{.skew_angle = between(-30, 30) * kRadian,
                                .stagger = between(-60, 60) * kRadian,
                                .twist = between(-60, 60) * kRadian,
                                .tip_chord = between(0.5, 1.2) * p.chord,
                                .lean = between(-10e-3, 10e-3),
                                .edge_thickness_fraction = between(0.1, 1)};
    const std::vector<Rule> rules = solid_rules(p, solid);  // cheap
    if (std::any_of(rules.begin(), rules.end(), [](const Rule& rule) { return rule.margin < 0; })) continue;
    if (!check_feasibility(p, solid, {.minimum_wall = 1e-3, .friction = 0.3}).feasible) continue;
    ++feasible;
    const MeshedSector meshed = family.mesh_of(p, solid);
    EXPECT_EQ(meshed.quality.inverted_elements, 0)
        << meshed.note << " skew " << solid.skew_angle / kRadian << " stagger " << solid.stagger / kRadian << " twist "
        << solid.twist / kRadian << " edge " << solid.edge_thickness_fraction << " chord " << p.chord << " slot "
        << p.slot_length;
  }
  EXPECT_GE(feasible, 80);
}

}  // namespace
}  // namespace dovetail::geometry
