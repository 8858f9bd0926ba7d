#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <numbers>

#include "core/errors.hpp"
#include "fem/sector_system.hpp"
#include "tests/unit/fem/extruded_mesh.hpp"
#include "tests/unit/fem/internal_block.hpp"
#include "tests/unit/fem/structured_mesh.hpp"

namespace dovetail::fem {
namespace {

using Complex = std::complex<double>;
constexpr int kSectors = 7;
constexpr double kLength = 0.03;

/// Four layers under three rows of contact nodes: the contact grid is coarser than the mesh.
SectorMesh tooth(bool merged = false) {
  return testing::extrude(testing::toothed_sector(2, 1, 2, kSectors, merged), 4, kLength, 3);
}

/// Bore held axially in its middle plane.
SectorMesh supported_tooth() {
  SectorMesh sector = tooth();
  for (int node : sector.bore_nodes)
    if (std::abs(sector.mesh.nodes(2, node) - kLength / 2) < 1e-9) sector.axial_nodes.push_back(node);
  return sector;
}

Eigen::VectorXd random_vector(Eigen::Index n) {
  std::srand(7);
  return Eigen::VectorXd::Random(n);
}

TEST(SpaceConstraints, RelativeDisplacementIsBilinearBetweenContactNodes) {
  const SectorMesh sector = tooth();
  const Constraints<double> constraints = real_constraints(sector);
  const Flank& flank = sector.flanks[0];
  ASSERT_EQ(constraints.contact_count, 3 * flank.contact_count());
  // A relative displacement bilinear in place: pairs must have it at their own place.
  const auto relative_at = [](const Eigen::Vector3d& p) {
    return Eigen::Vector3d(1 + 3 * p.x() - 2 * p.z() + 50 * p.x() * p.z(), 2 - p.x(), -1 + 4 * p.z());
  };
  Eigen::VectorXd x = random_vector(constraints.size());
  for (int i = 0; i < flank.contact_count(); ++i)
    x.segment<3>(constraints.internal_count + 3 * i) = relative_at(flank.position.col(i));
  const Eigen::VectorXd u = constraints.transformation * x;
  Eigen::Matrix3d frame;
  frame << flank.normal, flank.tangents;
  for (const auto& [blade, disk] : flank.pairs) {
    const Eigen::Vector3d jump = u.segment<3>(3 * blade) - u.segment<3>(3 * disk);
    EXPECT_LT((frame.transpose() * jump - relative_at(sector.mesh.nodes.col(blade))).norm(), 1e-13);
  }
}

TEST(SpaceConstraints, AreasAreTheIntegralsOfTheHats) {
  const SectorMesh sector = tooth();
  const ContactSurface surface = contact_surface(sector);
  const Flank& flank = sector.flanks[0];
  const double width = (flank.position.col(flank.grid[0] - 1) - flank.position.col(0)).norm();
  EXPECT_NEAR(surface.area.sum(), width * kLength, 1e-13 * surface.area.sum());
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < flank.grid[0]; ++i) {
      double along = 0;
      if (i > 0) along += (flank.position.col(i) - flank.position.col(i - 1)).norm() / 2;
      if (i + 1 < flank.grid[0]) along += (flank.position.col(i + 1) - flank.position.col(i)).norm() / 2;
      const double slot = kLength / 2 * (j == 1 ? 1.0 : 0.5);
      EXPECT_NEAR(surface.area[i + flank.grid[0] * j], along * slot, 1e-13 * surface.area.sum());
    }
}

TEST(SpaceConstraints, ContactForcesAreConjugateToPressureTimesArea) {
  // u_N = 1 everywhere moves the blade's side of the flank along n: the work of a pressure p is p times the area.
  const SectorMesh sector = tooth();
  const Constraints<double> constraints = real_constraints(sector);
  const ContactSurface surface = contact_surface(sector);
  const Flank& flank = sector.flanks[0];
  // Consistent load of a uniform pressure on flat nine-node faces: 1/6, 4/6, 1/6 in each direction.
  const auto share = [](int place, int last) { return place % 2 == 1 ? 4 : place == 0 || place == last ? 1 : 2; };
  const int across = 2 * flank.grid[0] - 1, levels = 9;
  const double width = (flank.position.col(flank.grid[0] - 1) - flank.position.col(0)).norm(), pressure = 3e6;
  const double unit = pressure * width * kLength / (6.0 * (flank.grid[0] - 1) * 6 * 4);
  Eigen::VectorXd force = Eigen::VectorXd::Zero(3 * sector.mesh.node_count());
  for (int l = 0; l < levels; ++l)
    for (int k = 0; k < across; ++k) {
      const int blade = flank.pairs[static_cast<std::size_t>(k + across * l)][0];
      force.segment<3>(3 * blade) = unit * share(k, across - 1) * share(l, levels - 1) * flank.normal;
    }
  const Eigen::VectorXd contact = (constraints.transformation.transpose() * force).tail(constraints.contact_count);
  for (Eigen::Index i = 0; i < surface.count(); ++i) {
    EXPECT_NEAR(contact[3 * i], pressure * surface.area[i], 1e-12 * pressure * surface.area.sum());
    EXPECT_NEAR(contact[3 * i + 1], 0, 1e-12 * pressure * surface.area.sum());
    EXPECT_NEAR(contact[3 * i + 2], 0, 1e-12 * pressure * surface.area.sum());
  }
}

TEST(SpaceConstraints, RightCutIsTheLeftCutTurnedAboutTheAxisWithItsPhase) {
  const SectorMesh sector = supported_tooth();
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(-2 * std::numbers::pi / kSectors, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  for (int diameter : {0, 2}) {
    const Constraints<Complex> constraints = complex_constraints(sector, BoreSupport::tangential, diameter);
    const Eigen::VectorXcd x = random_vector(2 * constraints.size()).reshaped(constraints.size(), 2) *
                               Eigen::Vector2cd(Complex(1, 0), Complex(0, 1));
    const Eigen::VectorXcd u = constraints.transformation * x;
    const Complex phase = std::polar(1.0, 2 * std::numbers::pi * diameter / kSectors);
    for (const auto& [left, right] : sector.cyclic_pairs)
      EXPECT_LT((u.segment<3>(3 * right) - phase * (turn * u.segment<3>(3 * left))).norm(), 1e-14);
  }
}

TEST(SpaceConstraints, SupportsCombineAtTheBore) {
  // Bore nodes in the middle plane: radial only, also the one on the right cut; elsewhere radial and axial.
  const SectorMesh sector = supported_tooth();
  const Constraints<double> constraints = real_constraints(sector);
  const Eigen::VectorXd u = constraints.transformation * random_vector(constraints.size());
  for (int node : sector.bore_nodes) {
    const Eigen::Vector3d r = sector.mesh.nodes.col(node), v = u.segment<3>(3 * node);
    EXPECT_NEAR(r.x() * v.y() - r.y() * v.x(), 0, 1e-15);
    EXPECT_GT(std::abs(r.x() * v.x() + r.y() * v.y()), 0);
    const bool held = std::abs(r.z() - kLength / 2) < 1e-9;
    EXPECT_EQ(v.z() == 0, held);
  }
  const Constraints<double> fixed = real_constraints(sector, BoreSupport::fixed);
  const Eigen::VectorXd still = fixed.transformation * random_vector(fixed.size());
  for (int node : sector.bore_nodes) EXPECT_EQ(still.segment<3>(3 * node).norm(), 0);
  // Every level has one bore node on the right cut, which follows.
  const Eigen::Index bore = static_cast<Eigen::Index>(sector.bore_nodes.size()) - 9;
  const Eigen::Index axial = static_cast<Eigen::Index>(sector.axial_nodes.size()) - 1;
  const Constraints<double> free = real_constraints(sector, BoreSupport::free);
  EXPECT_EQ(free.size() - constraints.size(), bore);
  EXPECT_EQ(constraints.size() - fixed.size(), 2 * bore - axial);
}

TEST(SpaceConstraints, BladeNodesOfAFlankFollowTheDiskWhateverTheirSupports) {
  SectorMesh sector = tooth();
  testing::hold_axially(sector);
  const Constraints<double> constraints = real_constraints(sector);
  ASSERT_EQ(constraints.contact_count, 3 * sector.flanks[0].contact_count());
  const Eigen::VectorXd u = constraints.transformation * random_vector(constraints.size());
  std::vector<bool> of_blade(static_cast<std::size_t>(sector.mesh.node_count()), false);
  for (const auto& [blade, disk] : sector.flanks[0].pairs) of_blade[static_cast<std::size_t>(blade)] = true;
  for (int k = 0; k < sector.mesh.node_count(); ++k)
    EXPECT_EQ(u[3 * k + 2] == 0, !of_blade[static_cast<std::size_t>(k)]);
}

TEST(SpaceConstraints, RefusesSupportsThatDifferOnTheCuts) {
  SectorMesh sector = supported_tooth();
  sector.axial_nodes.erase(std::find(sector.axial_nodes.begin(), sector.axial_nodes.end(), [&] {
    for (const auto& [left, right] : sector.cyclic_pairs)
      if (std::find(sector.axial_nodes.begin(), sector.axial_nodes.end(), right) != sector.axial_nodes.end())
        return right;
    return -1;
  }()));
  EXPECT_THROW((void)real_constraints(sector), InputError);
  SectorMesh slanted = tooth();
  slanted.flanks[0].tangents(2, 1) = 0.5;
  EXPECT_THROW((void)real_constraints(slanted), InputError);
  SectorMesh leaking = tooth();
  leaking.flanks[0].interpolation.coeffRef(0, 0) = 0.5;
  EXPECT_THROW((void)real_constraints(leaking), InputError);
  SectorMesh plane = testing::toothed_sector(2, 1, 2, kSectors, false);
  plane.axial_nodes = {0};
  EXPECT_THROW((void)real_constraints(plane), InputError);
}

TEST(SpaceSectorSystem, GluedSectorIsTheMergedMesh) {
  const std::vector<Material> materials{{.density = 4430},
                                        {.youngs_modulus = 2e11, .poisson_ratio = 0.3, .density = 7800}};
  const SectorMesh split = tooth(), merged = tooth(true);
  const SectorSystem a = build_sector_system(split, materials, Assembler(split.mesh));
  const SectorSystem b = build_sector_system(merged, materials, Assembler(merged.mesh));
  ASSERT_EQ(a.internal_size(), b.size());
  // The order of internal dofs differs; spectra and loads of the two agree, which traces of powers show.
  const Eigen::SparseMatrix<double> ka = internal_block(a.stiffness, a.constraints),
                                    ma = internal_block(a.mass, a.constraints);
  const auto trace = [](const Eigen::SparseMatrix<double>& p, const Eigen::SparseMatrix<double>& q) {
    return p.cwiseProduct(q).sum();
  };
  EXPECT_NEAR(trace(ka, ka), trace(b.stiffness, b.stiffness), 1e-12 * trace(ka, ka));
  EXPECT_NEAR(trace(ka, ma), trace(b.stiffness, b.mass), 1e-12 * trace(ka, ma));
  EXPECT_NEAR(trace(ma, ma), trace(b.mass, b.mass), 1e-12 * trace(ma, ma));
  EXPECT_NEAR(a.centrifugal.head(b.size()).norm(), b.centrifugal.norm(), 1e-12 * b.centrifugal.norm());
}

TEST(SpaceSectorSystem, SpinSofteningAndCentrifugalLoadLeaveTheAxisAlone) {
  const std::vector<Material> materials(2);
  const SectorMesh sector = tooth();
  const SectorSystem system = build_sector_system(sector, materials, Assembler(sector.mesh));
  Eigen::SparseMatrix<double> none = system.full.stiffness;
  none.coeffs().setZero();
  const double omega = 1000;
  const Eigen::SparseMatrix<double> change = stiffness_at_speed(system.full, none, omega) - system.full.stiffness;
  for (int c = 0; c < 3; ++c) {
    Eigen::VectorXd shift = Eigen::VectorXd::Zero(change.rows());
    for (Eigen::Index k = c; k < shift.size(); k += 3) shift[k] = 1;
    const double whole = body_mass(sector.mesh, materials, 0) + body_mass(sector.mesh, materials, 1);
    // Rounding of the stiffness that was added and taken away again.
    const double rounding = 1e-12 * system.full.stiffness.coeffs().abs().maxCoeff();
    EXPECT_NEAR(shift.dot(change * shift), c == 2 ? 0 : -omega * omega * whole, rounding) << c;
  }
  const Eigen::VectorXd load = centrifugal_load(system.full.mass, sector.mesh);
  for (Eigen::Index k = 2; k < load.size(); k += 3) EXPECT_EQ(load[k], 0);
}

}  // namespace
}  // namespace dovetail::fem
