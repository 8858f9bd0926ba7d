#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "fem/diameter_frequencies.hpp"
#include "fem/glued_modes.hpp"
#include "fem/sector_system.hpp"
#include "numerics/dense_symmetric.hpp"
#include "tests/unit/fem/extruded_mesh.hpp"
#include "tests/unit/fem/internal_block.hpp"
#include "tests/unit/fem/structured_mesh.hpp"

namespace dovetail::fem {
namespace {

constexpr int kSectors = 5;

/// A lopsided sector, so that clockwise and counter-clockwise differ.
SectorMesh lopsided_sector() {
  testing::Grid grid = testing::make_grid(2, 2, testing::annular_sector(0.1, 0.25, kSectors));
  grid.mesh.nodes.col(grid.node(4, 2)) += Eigen::Vector2d(0.02, 0.05);
  grid.mesh.nodes.col(grid.node(2, 2)) += Eigen::Vector2d(0.012, 0.004);
  return testing::annulus_sector(grid, kSectors);
}

/// The same in space, one layer, twisted so that no cross-section is like another; held axially at the bore's foot.
SectorMesh lopsided_solid() {
  SectorMesh sector = testing::extrude(lopsided_sector(), 1, 0.06, 1);
  const Eigen::Index level = sector.mesh.nodes.cols() / 3;
  sector.mesh.nodes.col(2 * level + 14) += Eigen::Vector3d(0.01, 0.02, 0.015);
  sector.mesh.nodes.col(level + 12) += Eigen::Vector3d(0.004, -0.003, 0.006);
  for (int node : sector.bore_nodes)
    if (node < level) sector.axial_nodes.push_back(node);
  return sector;
}

/// The whole ring, sector k turned clockwise by k sector angles and joined at the cuts; bore held tangentially.
struct Ring {
  Mesh mesh;
  Eigen::SparseMatrix<double> selection;

  explicit Ring(const SectorMesh& sector) {
    const int n = sector.mesh.node_count();
    std::vector<int> image(static_cast<std::size_t>(n), -1), number(static_cast<std::size_t>(n), -1);
    for (const std::array<int, 2>& pair : sector.cyclic_pairs) image[static_cast<std::size_t>(pair[1])] = pair[0];
    int kept = 0;
    for (std::size_t k = 0; k < number.size(); ++k)
      if (image[k] < 0) number[k] = kept++;
    const int d = sector.mesh.dimensions();
    mesh.kind = sector.mesh.kind;
    mesh.nodes.resize(d, kSectors * kept);
    mesh.regions = sector.mesh.regions;
    std::vector<bool> on_bore(static_cast<std::size_t>(kSectors * kept), false), axial = on_bore;
    for (int s = 0; s < kSectors; ++s) {
      Eigen::MatrixXd turn = Eigen::MatrixXd::Identity(d, d);
      turn.topLeftCorner<2, 2>() = Eigen::Rotation2D<double>(-2 * std::numbers::pi * s / kSectors).toRotationMatrix();
      const Eigen::MatrixXd turned = turn * sector.mesh.nodes;
      // The right cut of a sector is the left cut of the next one clockwise.
      const auto ring_node = [&](int node) {
        const int left = image[static_cast<std::size_t>(node)];
        return left < 0 ? s * kept + number[static_cast<std::size_t>(node)]
                        : (s + 1) % kSectors * kept + number[static_cast<std::size_t>(left)];
      };
      for (int k = 0; k < n; ++k)
        if (image[static_cast<std::size_t>(k)] < 0) mesh.nodes.col(ring_node(k)) = turned.col(k);
      for (int node : sector.mesh.connectivity) mesh.connectivity.push_back(ring_node(node));
      mesh.region.insert(mesh.region.end(), sector.mesh.region.begin(), sector.mesh.region.end());
      for (int node : sector.bore_nodes) on_bore[static_cast<std::size_t>(ring_node(node))] = true;
      for (int node : sector.axial_nodes) axial[static_cast<std::size_t>(ring_node(node))] = true;
    }
    std::vector<Eigen::Triplet<double>> entries;
    int column = 0;
    for (int k = 0; k < mesh.node_count(); ++k) {
      const Eigen::Vector2d radial = mesh.nodes.col(k).head<2>().normalized();
      for (int c = 0; c < 2; ++c)
        entries.emplace_back(d * k + c, on_bore[static_cast<std::size_t>(k)] ? column : column + c,
                             on_bore[static_cast<std::size_t>(k)] ? radial[c] : 1.0);
      column += on_bore[static_cast<std::size_t>(k)] ? 1 : 2;
      if (d == 3 && !axial[static_cast<std::size_t>(k)]) entries.emplace_back(d * k + 2, column++, 1.0);
    }
    selection.resize(d * mesh.nodes.cols(), column);
    selection.setFromTriplets(entries.begin(), entries.end());
  }
};

Eigen::VectorXd sorted(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return Eigen::Map<Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

class CyclicSymmetry : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Dimensions, CyclicSymmetry, ::testing::Values(2, 3));

TEST_P(CyclicSymmetry, NodalDiametersTogetherAreTheFullRing) {
  const SectorMesh sector = GetParam() == 2 ? lopsided_sector() : lopsided_solid();
  const std::vector<Material> materials{Material{}};
  const Ring ring(sector);
  const FullMatrices full_ring = Assembler(ring.mesh).stiffness_and_mass(ring.mesh, materials);
  const Eigen::MatrixXd ring_stiffness = testing::restrict_to(full_ring.stiffness, ring.selection);
  const Eigen::MatrixXd ring_mass = testing::restrict_to(full_ring.mass, ring.selection);
  const Eigen::VectorXd expected = numerics::all_values<double>(ring_stiffness, ring_mass).values;

  const FullMatrices full = Assembler(sector.mesh).stiffness_and_mass(sector.mesh, materials);
  std::vector<double> found;
  for (int diameter = 0; diameter <= kSectors / 2; ++diameter) {
    const Constraints<std::complex<double>> constraints =
        complex_constraints(sector, BoreSupport::tangential, diameter);
    const Eigen::MatrixXcd stiffness = constrain(full.stiffness, constraints), mass = constrain(full.mass, constraints);
    const Eigen::VectorXd values = numerics::all_values<std::complex<double>>(stiffness, mass).values;
    for (double value : values) found.insert(found.end(), diameter == 0 ? 1 : 2, value);  // both directions of travel
  }
  const Eigen::VectorXd values = sorted(found);
  ASSERT_EQ(values.size(), expected.size());
  EXPECT_LT(((values - expected).array() / expected.array()).abs().maxCoeff(), 1e-9);

  // The Lanczos path finds the lowest of each diameter.
  const NodalDiameterFrequencies frequencies =
      nodal_diameter_frequencies(sector, full.stiffness, full.mass, BoreSupport::tangential, {.modes = {.count = 6}});
  std::vector<double> lowest;
  for (std::size_t k = 0; k < frequencies.nodal_diameters.size(); ++k) {
    EXPECT_EQ(frequencies.status[k], Status::converged);
    for (double f : frequencies.frequency.row(static_cast<Eigen::Index>(k)))
      lowest.insert(lowest.end(), k == 0 ? 1 : 2, std::pow(2 * std::numbers::pi * f, 2));
  }
  const Eigen::VectorXd lanczos = sorted(lowest);
  EXPECT_LT(((lanczos - expected.head(lanczos.size())).array() / lanczos.array()).abs().head(10).maxCoeff(), 1e-9);
}

TEST(GluedModes, ComplexModesAreOrthonormalAndSatisfyTheirEquation) {
  const SectorMesh sector = testing::toothed_sector(4, 3, 3, 9, false);
  const std::vector<Material> materials(2);
  const FullMatrices full = Assembler(sector.mesh).stiffness_and_mass(sector.mesh, materials);
  const Constraints<std::complex<double>> constraints = complex_constraints(sector, BoreSupport::tangential, 2);
  numerics::SparseCholesky<std::complex<double>> cholesky;
  const numerics::Modes<std::complex<double>> modes =
      glued_modes(full.stiffness, full.mass, constraints, {.count = 8}, cholesky);
  ASSERT_EQ(modes.status, Status::converged);
  const Eigen::MatrixXcd stiffness = internal_block(constrain(full.stiffness, constraints), constraints);
  const Eigen::MatrixXcd mass = internal_block(constrain(full.mass, constraints), constraints);
  const Eigen::VectorXd expected = numerics::all_values<std::complex<double>>(stiffness, mass).values.head(8);
  EXPECT_LT(((modes.eigenvalues - expected).array() / expected.array()).abs().maxCoeff(), 1e-9);
  const Eigen::MatrixXcd gram = modes.vectors.adjoint() * mass * modes.vectors;
  EXPECT_LT((gram - Eigen::MatrixXcd::Identity(8, 8)).norm(), 1e-10);
  const Eigen::MatrixXcd residual =
      stiffness * modes.vectors - mass * modes.vectors * modes.eigenvalues.asDiagonal().toDenseMatrix();
  // Shift-invert leaves K^{-1} times the residual small, the residual itself up to the stiffest scale.
  EXPECT_LT(residual.norm(), 1e-7 * (stiffness * modes.vectors).norm());
}

TEST(GluedModes, GluedFlanksAreTheMergedMesh) {
  const std::vector<Material> materials{{.density = 4430},
                                        {.youngs_modulus = 2e11, .poisson_ratio = 0.3, .density = 7800}};
  const SectorMesh split = testing::toothed_sector(4, 3, 3, 9, false);
  const SectorMesh merged = testing::toothed_sector(4, 3, 3, 9, true);
  const FullMatrices a = Assembler(split.mesh).stiffness_and_mass(split.mesh, materials);
  const FullMatrices b = Assembler(merged.mesh).stiffness_and_mass(merged.mesh, materials);
  for (const std::vector<int> diameters{0, 1, 4}; int diameter : diameters) {
    const std::vector<int> one{diameter};
    const auto first = nodal_diameter_frequencies(split, a.stiffness, a.mass, BoreSupport::tangential, {}, one);
    const auto second = nodal_diameter_frequencies(merged, b.stiffness, b.mass, BoreSupport::tangential, {}, one);
    ASSERT_EQ(first.status[0], Status::converged);
    ASSERT_EQ(second.status[0], Status::converged);
    EXPECT_LT((first.frequency - second.frequency).norm(), 1e-9 * first.frequency.norm()) << diameter;
  }
}

/// Some contact dofs held rigidly, others by springs: dense eigenvalues of the assembled matrices with the springs in
/// them, at every diameter, also of those that are interpolated.
TEST(GluedModes, AreHeldThroughSprings) {
  const SectorMesh sector = testing::toothed_sector(4, 3, 3, 9, false);
  const std::vector<Material> materials(2);
  const FullMatrices full = Assembler(sector.mesh).stiffness_and_mass(sector.mesh, materials);
  const Constraints<double> real = real_constraints(sector);
  Eigen::VectorXd flexibility = Eigen::VectorXd::Zero(real.contact_count);
  for (Eigen::Index c = 0; c < flexibility.size(); ++c)
    if (c % 3 != 1) flexibility(c) = 1e-8 * static_cast<double>(1 + c);
  const numerics::ModesOptions modes{.count = 4, .tolerance = 1e-11};
  const auto found = [&](const Eigen::VectorXd& springs, double tolerance) {
    return nodal_diameter_frequencies(sector, full.stiffness, full.mass, BoreSupport::tangential,
                                      {.modes = modes, .tolerance = tolerance, .contact_flexibility = springs});
  };
  const NodalDiameterFrequencies held = found(flexibility, 0), between = found(flexibility, 1e-6);
  for (std::size_t k = 0; k < held.nodal_diameters.size(); ++k) {
    const Constraints<std::complex<double>> all =
        complex_constraints(sector, BoreSupport::tangential, held.nodal_diameters[k]);
    Eigen::MatrixXcd stiffness = constrain(full.stiffness, all), mass = constrain(full.mass, all);
    std::vector<Eigen::Index> free;
    for (Eigen::Index i = 0; i < all.size(); ++i) {
      const Eigen::Index c = i - all.internal_count;
      if (c >= 0 && flexibility(c) > 0) stiffness(i, i) += 1 / flexibility(c);
      if (c < 0 || flexibility(c) > 0) free.push_back(i);
    }
    const Eigen::VectorXd values = numerics::all_values<std::complex<double>>(Eigen::MatrixXcd(stiffness(free, free)),
                                                                              Eigen::MatrixXcd(mass(free, free)))
                                       .values.head(4);
    const Eigen::RowVectorXd expected = values.cwiseSqrt().transpose() / (2 * std::numbers::pi);
    const auto row = static_cast<Eigen::Index>(k);
    EXPECT_LT((held.frequency.row(row) - expected).cwiseQuotient(expected).cwiseAbs().maxCoeff(), 1e-9) << k;
    EXPECT_LT((between.frequency.row(row) - expected).cwiseQuotient(expected).cwiseAbs().maxCoeff(), 1e-6) << k;
  }
  const NodalDiameterFrequencies rigid = found({}, 0), stiff = found(1e-12 * flexibility, 0);
  EXPECT_LT((stiff.frequency - rigid.frequency).norm(), 1e-9 * rigid.frequency.norm());
  EXPECT_GT((held.frequency - rigid.frequency).norm(), 1e-2 * rigid.frequency.norm());
}

/// A sector of a thick disk, a little lopsided.
SectorMesh disk_sector(int sectors, int columns, int rows) {
  testing::Grid grid = testing::make_grid(columns, rows, testing::annular_sector(0.12, 0.25, sectors));
  grid.mesh.nodes(1, grid.node(columns, 2)) += 0.002;
  return testing::annulus_sector(grid, sectors);
}

/// Every diameter of a sector of 47 within the tolerance, with fewer than half of the sparse problems.
TEST(NodalDiameters, AreFoundFromModesOfAFewOfThem) {
  constexpr int kBlades = 47;
  const SectorMesh sector = disk_sector(kBlades, 4, 3);
  const std::vector<Material> materials{Material{}};
  const FullMatrices full = Assembler(sector.mesh).stiffness_and_mass(sector.mesh, materials);
  const numerics::ModesOptions modes{.count = 6, .tolerance = 1e-11};
  const NodalDiameterFrequencies exact =
      nodal_diameter_frequencies(sector, full.stiffness, full.mass, BoreSupport::tangential, {.modes = modes});
  for (const double tolerance : {1e-4, 1e-6, 1e-8}) {
    const NodalDiameterFrequencies found = nodal_diameter_frequencies(
        sector, full.stiffness, full.mass, BoreSupport::tangential, {.modes = modes, .tolerance = tolerance});
    EXPECT_EQ(found.status, exact.status);
    const Eigen::MatrixXd relative = (found.frequency - exact.frequency).cwiseQuotient(exact.frequency);
    EXPECT_LT(relative.maxCoeff(), tolerance);
    EXPECT_GT(relative.minCoeff(), -1e-9);  // Ritz values come from above
    const auto solved = std::count(found.solved.begin(), found.solved.end(), true);
    EXPECT_LT(solved, tolerance < 1e-7 ? 16 : 12) << tolerance;
  }
}

// A tolerance below rounding: no round settles, and every diameter is solved for itself.
TEST(NodalDiameters, AreSolvedOneByOneWhereRoundsDoNotSettle) {
  const SectorMesh sector = disk_sector(9, 10, 6);
  const std::vector<Material> materials{Material{}};
  const FullMatrices full = Assembler(sector.mesh).stiffness_and_mass(sector.mesh, materials);
  const numerics::ModesOptions modes{.count = 2, .tolerance = 1e-11};
  const auto found = [&](double tolerance) {
    return nodal_diameter_frequencies(sector, full.stiffness, full.mass, BoreSupport::tangential,
                                      {.modes = modes, .tolerance = tolerance});
  };
  const NodalDiameterFrequencies exact = found(0), rounds = found(1e-30);
  EXPECT_EQ(rounds.status, exact.status);
  EXPECT_EQ(std::count(rounds.solved.begin(), rounds.solved.end(), true), 5);
  EXPECT_LT((rounds.frequency - exact.frequency).norm(), 1e-9 * exact.frequency.norm());
}

TEST(GluedModes, LowersTheShiftForAFloatingBody) {
  // A free annulus turns rigidly at diameter 0: one zero frequency, then the elastic ones.
  const SectorMesh sector = lopsided_sector();
  const std::vector<Material> materials{Material{}};
  const FullMatrices full = Assembler(sector.mesh).stiffness_and_mass(sector.mesh, materials);
  const Constraints<double> constraints = real_constraints(sector, BoreSupport::free);
  numerics::SparseCholesky<double> cholesky;
  // Asked for more accurately than they are held to.
  const numerics::Modes<double> modes =
      glued_modes(full.stiffness, full.mass, constraints, {.count = 4, .tolerance = 1e-11}, cholesky);
  ASSERT_EQ(modes.status, Status::converged);
  EXPECT_LT(modes.shift, 0);
  const Eigen::MatrixXd stiffness = constrain(full.stiffness, constraints), mass = constrain(full.mass, constraints);
  const Eigen::VectorXd expected = numerics::all_values<double>(stiffness, mass).values.head(4);
  EXPECT_LT(std::abs(modes.eigenvalues[0]), 1e-6 * modes.eigenvalues[1]);
  // The rigid mode outweighs the others in K - sigma M by lambda / |sigma|, and so does its rounding.
  const double rounding = 2.2e-16 * expected[3] / std::abs(modes.shift);
  EXPECT_LT(rounding, 1e-7);
  EXPECT_LT(((modes.eigenvalues - expected).array() / expected[3]).abs().maxCoeff(), rounding);
}

}  // namespace
}  // namespace dovetail::fem
