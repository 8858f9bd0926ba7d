#include "fem/constraints.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

#include "core/errors.hpp"
#include "fem/sector_system.hpp"
#include "numerics/dense_general.hpp"
#include "tests/unit/fem/internal_block.hpp"
#include "tests/unit/fem/structured_mesh.hpp"

namespace dovetail::fem {
namespace {

using Complex = std::complex<double>;
constexpr int kSectors = 7;

SectorMesh tooth() {
  return testing::toothed_sector(3, 2, 2, kSectors, false);
}

Eigen::VectorXd random_vector(Eigen::Index n) {
  std::srand(7);
  return Eigen::VectorXd::Random(n);
}

TEST(Constraints, RelativeDisplacementsOpenTheFlankAlongItsAxes) {
  const SectorMesh sector = tooth();
  const Constraints<double> constraints = real_constraints(sector);
  const Flank& flank = sector.flanks[0];
  ASSERT_EQ(constraints.contact_count, 2 * flank.contact_count());
  const Eigen::VectorXd x = random_vector(constraints.size());
  const Eigen::VectorXd u = constraints.transformation * x;
  const auto relative = [&](const std::array<int, 2>& pair) {
    const Eigen::Vector2d jump = u.segment<2>(2 * pair[0]) - u.segment<2>(2 * pair[1]);
    return Eigen::Vector2d(flank.normal.dot(jump), flank.tangents.col(0).dot(jump));
  };
  for (int k = 0; k < flank.contact_count(); ++k) {
    const std::size_t corner = static_cast<std::size_t>(2 * k);
    const Eigen::Vector2d expected = x.segment<2>(constraints.internal_count + 2 * k);
    EXPECT_LT((relative(flank.pairs[corner]) - expected).norm(), 1e-15);
    if (k + 1 == flank.contact_count()) break;
    const Eigen::Vector2d next = x.segment<2>(constraints.internal_count + 2 * k + 2);
    EXPECT_LT((relative(flank.pairs[corner + 1]) - 0.5 * (expected + next)).norm(), 1e-15);
  }
}

TEST(Constraints, ContactForcesAreConjugateToPressureTimesArea) {
  // A uniform pressure on the blade flank, as the consistent load 1/6, 4/6, 1/6 of straight edges.
  const SectorMesh sector = tooth();
  const Constraints<double> constraints = real_constraints(sector);
  const ContactSurface surface = contact_surface(sector);
  const Flank& flank = sector.flanks[0];
  const double pressure = 3e6, thickness = 0.02;
  Eigen::VectorXd force = Eigen::VectorXd::Zero(2 * sector.mesh.node_count());
  for (std::size_t k = 0; k + 2 < flank.pairs.size(); k += 2) {
    const int a = flank.pairs[k][0], m = flank.pairs[k + 1][0], b = flank.pairs[k + 2][0];
    const double length = (sector.mesh.nodes.col(b) - sector.mesh.nodes.col(a)).norm();
    const Eigen::Vector2d total = pressure * length * thickness * flank.normal;
    force.segment<2>(2 * a) += total / 6;
    force.segment<2>(2 * m) += total * 4 / 6;
    force.segment<2>(2 * b) += total / 6;
  }
  const Eigen::VectorXd contact = (constraints.transformation.transpose() * force).tail(constraints.contact_count);
  for (Eigen::Index k = 0; k < surface.count(); ++k) {
    EXPECT_NEAR(contact[2 * k], pressure * surface.area[k], 1e-13 * pressure * surface.area.sum());
    EXPECT_NEAR(contact[2 * k + 1], 0, 1e-13 * pressure * surface.area.sum());
    EXPECT_GT(surface.area[k], 0);
  }
}

TEST(Constraints, RightCutIsTheRotatedLeftCutWithItsPhase) {
  const SectorMesh sector = tooth();
  const Eigen::Rotation2D<double> rotation(-2 * std::numbers::pi / kSectors);
  for (int diameter : {0, 1, 3}) {
    const Constraints<Complex> constraints = complex_constraints(sector, BoreSupport::tangential, diameter);
    const Eigen::VectorXcd x = random_vector(2 * constraints.size()).reshaped(constraints.size(), 2) *
                               Eigen::Vector2cd(Complex(1, 0), Complex(0, 1));
    const Eigen::VectorXcd u = constraints.transformation * x;
    const Complex phase = std::polar(1.0, 2 * std::numbers::pi * diameter / kSectors);
    for (const std::array<int, 2>& pair : sector.cyclic_pairs) {
      const Eigen::Vector2cd left = u.segment<2>(2 * pair[0]), right = u.segment<2>(2 * pair[1]);
      EXPECT_LT((right - phase * (rotation.toRotationMatrix() * left)).norm(), 1e-14);
    }
  }
}

TEST(Constraints, BoreMovesOnlyRadiallyOrNotAtAll) {
  const SectorMesh sector = tooth();
  const Constraints<double> tangential = real_constraints(sector, BoreSupport::tangential);
  const Constraints<double> fixed = real_constraints(sector, BoreSupport::fixed);
  const Constraints<double> free = real_constraints(sector, BoreSupport::free);
  const Eigen::VectorXd u = tangential.transformation * random_vector(tangential.size());
  const Eigen::VectorXd still = fixed.transformation * random_vector(fixed.size());
  for (int node : sector.bore_nodes) {
    const Eigen::Vector2d r = sector.mesh.nodes.col(node).normalized(), v = u.segment<2>(2 * node);
    EXPECT_NEAR(r.x() * v.y() - r.y() * v.x(), 0, 1e-15);
    EXPECT_GT(std::abs(r.dot(v)), 0);
    EXPECT_EQ(still.segment<2>(2 * node).norm(), 0);
  }
  // One of the two bore corners follows the other.
  const Eigen::Index bore = static_cast<Eigen::Index>(sector.bore_nodes.size()) - 1;
  EXPECT_EQ(free.size() - tangential.size(), bore);
  EXPECT_EQ(tangential.size() - fixed.size(), bore);
}

TEST(Constraints, RigidRotationOfTheFreeRingIsInTheSpaceOfDiameterZero) {
  // The velocity of a rigid rotation must be representable: least squares residual of T x = e_z cross r.
  const SectorMesh sector = tooth();
  const Constraints<double> constraints = real_constraints(sector, BoreSupport::free);
  Eigen::VectorXd rotation(2 * sector.mesh.node_count());
  for (int k = 0; k < sector.mesh.node_count(); ++k)
    rotation.segment<2>(2 * k) << -sector.mesh.nodes(1, k), sector.mesh.nodes(0, k);
  const Eigen::MatrixXd t(constraints.transformation);
  const Eigen::VectorXd x = numerics::least_squares(t, rotation, 1e-12);
  EXPECT_LT((t * x - rotation).cwiseAbs().maxCoeff(), 1e-13);
  EXPECT_LT(x.tail(constraints.contact_count).cwiseAbs().maxCoeff(), 1e-13);
}

TEST(Constraints, EvenNumbersOfSectorsHaveARealLastDiameter) {
  const SectorMesh sector = testing::toothed_sector(2, 1, 1, 6, false);
  const Constraints<double> real = real_constraints(sector, BoreSupport::tangential, 3);
  const Constraints<Complex> complex = complex_constraints(sector, BoreSupport::tangential, 3);
  const Eigen::MatrixXcd difference = Eigen::MatrixXcd(complex.transformation) - Eigen::MatrixXd(real.transformation);
  EXPECT_LT(difference.cwiseAbs().maxCoeff(), 1e-15);
}

TEST(Constraints, RefusesWhatDoesNotMatch) {
  const SectorMesh sector = tooth();
  EXPECT_THROW((void)real_constraints(sector, BoreSupport::tangential, 1), InputError);
  EXPECT_THROW((void)complex_constraints(sector, BoreSupport::tangential, 4), InputError);
  SectorMesh swapped = sector;
  for (std::array<int, 2>& pair : swapped.cyclic_pairs) std::swap(pair[0], pair[1]);
  EXPECT_THROW((void)real_constraints(swapped), InputError);
  SectorMesh twice = sector;
  twice.flanks[0].pairs.back() = twice.flanks[0].pairs.front();
  EXPECT_THROW((void)real_constraints(twice), InputError);
  SectorMesh short_flank = sector;
  short_flank.flanks[0].pairs.pop_back();
  EXPECT_THROW((void)real_constraints(short_flank), InputError);
}

TEST(SectorSystem, GluedSectorIsTheMergedMesh) {
  const std::vector<Material> materials{{.density = 4430},
                                        {.youngs_modulus = 2e11, .poisson_ratio = 0.3, .density = 7800}};
  const SectorMesh split = tooth(), merged = testing::toothed_sector(3, 2, 2, kSectors, true);
  const SectorSystem a = build_sector_system(split, materials, Assembler(split.mesh));
  const SectorSystem b = build_sector_system(merged, materials, Assembler(merged.mesh));
  ASSERT_EQ(a.internal_size(), b.size());
  ASSERT_EQ(b.contact_size(), 0);
  // Blade copies follow their disk nodes directly, so the independent dofs come in the same order.
  const Eigen::MatrixXd stiffness = internal_block(a.stiffness, a.constraints),
                        mass = internal_block(a.mass, a.constraints);
  EXPECT_LT((stiffness - Eigen::MatrixXd(b.stiffness)).norm(), 1e-13 * stiffness.norm());
  EXPECT_LT((mass - Eigen::MatrixXd(b.mass)).norm(), 1e-13 * mass.norm());
  EXPECT_LT((a.centrifugal.head(b.size()) - b.centrifugal).norm(), 1e-13 * b.centrifugal.norm());
  EXPECT_EQ(a.tip.head(b.size()), b.tip);
}

TEST(SectorSystem, RigidBladeOpensTheFlankWithoutStrainEnergy) {
  // The blade lifted along +y while the disk rests: u_N = n . u = -1 at every contact node, no energy.
  const std::vector<Material> materials(2);
  const SectorMesh sector = tooth();
  const SectorSystem system = build_sector_system(sector, materials, Assembler(sector.mesh));
  Eigen::VectorXd lifted = Eigen::VectorXd::Zero(2 * sector.mesh.node_count());
  for (int e = 0; e < sector.mesh.element_count(); ++e)
    if (sector.mesh.region_of(e).body == 0)
      for (int node : sector.mesh.element(e)) lifted[2 * node + 1] = 1;
  const Eigen::MatrixXd t(system.constraints.transformation);
  const Eigen::VectorXd x = numerics::least_squares(t, lifted, 1e-12);
  ASSERT_LT((t * x - lifted).cwiseAbs().maxCoeff(), 1e-12);
  for (Eigen::Index k = 0; k < system.contact_size(); k += 2) {
    EXPECT_NEAR(x[system.internal_size() + k], -1, 1e-12);
    EXPECT_NEAR(x[system.internal_size() + k + 1], 0, 1e-12);
  }
  const double scale = system.stiffness.coeff(0, 0);
  EXPECT_LT(std::abs(x.dot(system.stiffness * x)), 1e-10 * scale);
}

TEST(SectorSystem, TipVectorPicksTheTangentialDisplacement) {
  const std::vector<Material> materials(2);
  const SectorMesh sector = tooth();
  const SectorSystem system = build_sector_system(sector, materials, Assembler(sector.mesh));
  const Eigen::VectorXd x = random_vector(system.size());
  const Eigen::VectorXd u = system.constraints.transformation * x;
  EXPECT_DOUBLE_EQ(system.tip.dot(x), u[2 * sector.tip_node]);
}

}  // namespace
}  // namespace dovetail::fem
