#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "fem/diameter_frequencies.hpp"
#include "fem/stress.hpp"
#include "reduction/static_condensation.hpp"
#include "steady/preload.hpp"
#include "tests/unit/fem/extruded_mesh.hpp"
#include "tests/unit/fem/internal_block.hpp"
#include "tests/unit/fem/structured_mesh.hpp"
#include "tests/verification/fem/sector_model.hpp"

namespace dovetail::fem {
namespace {

constexpr int kSectorsOfSection = 9;
constexpr double kLength = 0.03;

/// A plane section of one thickness and the same extruded with every node held axially: the same structure.
class ExtrudedSection : public ::testing::Test {
 protected:
  ExtrudedSection() {
    plane.mesh.regions[0].thickness = plane.mesh.regions[1].thickness = kLength;
    // A crowned flank, so that pressures are uneven.
    Flank& flank = plane.flanks[0];
    const int last = flank.grid[0] - 1;
    for (int i = 0; i <= last; ++i) flank.gap[i] = 2e-6 * std::pow(2.0 * i / last - 1, 2);
    solid = testing::extrude(plane, 2, kLength, 1);
    testing::hold_axially(solid);
  }
  SectorMesh plane = testing::toothed_sector(4, 3, 4, kSectorsOfSection, false), solid;
  const std::vector<Material> materials{{.density = 4430},
                                        {.youngs_modulus = 2e11, .poisson_ratio = 0.3, .density = 7800}};
};

TEST_F(ExtrudedSection, HasTheGluedFrequenciesOfPlaneStrainAtEveryNodalDiameter) {
  const FullMatrices a = Assembler(plane.mesh).stiffness_and_mass(plane.mesh, materials);
  const FullMatrices b = Assembler(solid.mesh).stiffness_and_mass(solid.mesh, materials);
  // The plane modes are the lowest of the solid: its next ones vary along z, with two half waves in 30 mm.
  const DiameterOptions options{.modes = {.count = 6, .tolerance = 1e-11}};
  for (const std::vector<int> diameters{0, 1, 4}; int diameter : diameters) {
    const std::vector<int> one{diameter};
    const auto flat = nodal_diameter_frequencies(plane, a.stiffness, a.mass, BoreSupport::tangential, options, one);
    const auto deep = nodal_diameter_frequencies(solid, b.stiffness, b.mass, BoreSupport::tangential, options, one);
    ASSERT_EQ(flat.status[0], Status::converged);
    ASSERT_EQ(deep.status[0], Status::converged);
    EXPECT_LT((flat.frequency - deep.frequency).cwiseAbs().maxCoeff(), 1e-9 * flat.frequency.maxCoeff()) << diameter;
  }
}

TEST_F(ExtrudedSection, HasThePreloadOfPlaneStrain) {
  // Uniform contact along the slot: one row of contact nodes with the areas of the plane section. Friction may act in
  // both directions, but nothing moves along the slot.
  const SectorSystem a = build_sector_system(plane, materials, Assembler(plane.mesh));
  const SectorSystem b = build_sector_system(solid, materials, Assembler(solid.mesh));
  ASSERT_EQ(b.contact.count(), a.contact.count());
  EXPECT_LT((a.contact.area - b.contact.area).cwiseAbs().maxCoeff(), 1e-13 * a.contact.area.maxCoeff());
  const auto preload = [](const SectorSystem& system) {
    // A pull on the tooth would lift it off its foot: the joint is loaded by the opposite of the centrifugal load.
    reduction::FullModel full = testing::sector_model(system, 1000, 0.4);
    full.static_force *= -1;
    const reduction::StaticCondensation condensed = reduction::condense_statically(full);
    EXPECT_EQ(condensed.status, Status::converged);
    return steady::quasi_static(std::make_shared<const dynamics::CondensedModel>(condensed.model));
  };
  const steady::Preload flat = preload(a), deep = preload(b);
  ASSERT_EQ(flat.status, Status::converged);
  ASSERT_EQ(deep.status, Status::converged);
  // Both solves stop at a residual of 1e-10 of the load.
  EXPECT_GT(flat.pressure.maxCoeff(), 0);
  EXPECT_LT((flat.pressure - deep.pressure).cwiseAbs().maxCoeff(), 1e-8 * flat.pressure.maxCoeff());
  const Eigen::Index count = a.contact.count();
  for (Eigen::Index i = 0; i < count; ++i) {
    EXPECT_NEAR(deep.force[3 * i], flat.force[2 * i], 1e-8 * flat.force.cwiseAbs().maxCoeff());
    EXPECT_NEAR(deep.force[3 * i + 1], flat.force[2 * i + 1], 1e-8 * flat.force.cwiseAbs().maxCoeff());
    EXPECT_NEAR(deep.force[3 * i + 2], 0, 1e-8 * flat.force.cwiseAbs().maxCoeff());
  }
}

TEST_F(ExtrudedSection, HasTheStressesOfPlaneStrainInEveryLayer) {
  const SectorSystem a = build_sector_system(plane, materials, Assembler(plane.mesh));
  const SectorSystem b = build_sector_system(solid, materials, Assembler(solid.mesh));
  const auto glued = [](const SectorSystem& system) {
    numerics::SparseCholesky<double> cholesky;
    EXPECT_EQ(cholesky.factorise(internal_block(system.stiffness, system.constraints)), Status::converged);
    Eigen::VectorXd x = Eigen::VectorXd::Zero(system.size());
    x.head(system.internal_size()) = cholesky.solve(system.centrifugal.head(system.internal_size()));
    return Eigen::VectorXd(system.constraints.transformation * x);
  };
  const int n = plane.mesh.node_count();
  // Nodes of one body, away from the foot's split nodes.
  const std::vector<int> flat_nodes{plane.tip_node, plane.bore_nodes[3], plane.cyclic_pairs[2][0]};
  const Eigen::VectorXd flat = nodal_stress_operator(plane.mesh, materials, flat_nodes) * glued(a);
  const Eigen::VectorXd u = glued(b);
  for (int level = 0; level < 5; ++level) {
    std::vector<int> nodes = flat_nodes;
    for (int& node : nodes) node += n * level;
    const Eigen::VectorXd deep = nodal_stress_operator(solid.mesh, materials, nodes) * u;
    for (Eigen::Index k = 0; k < 3; ++k) {
      const Eigen::Vector3d s = flat.segment<3>(3 * k);
      const double nu = k == 0 ? materials[0].poisson_ratio : materials[1].poisson_ratio;
      Eigen::VectorXd expected(6);
      expected << s[0], s[1], nu * (s[0] + s[1]), s[2], 0, 0;
      EXPECT_LT((deep.segment<6>(6 * k) - expected).norm(), 1e-9 * flat.norm()) << level << " " << k;
      EXPECT_NEAR(von_mises(deep.segment<6>(6 * k), 0), von_mises(s, nu), 1e-9 * flat.norm());
    }
  }
}

}  // namespace
}  // namespace dovetail::fem
