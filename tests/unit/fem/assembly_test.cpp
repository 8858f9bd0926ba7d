#include "fem/assembly.hpp"

#include <gtest/gtest.h>

#include <utility>

#include "core/errors.hpp"
#include "fem/element.hpp"
#include "fem/stress.hpp"
#include "tests/unit/fem/structured_mesh.hpp"

namespace dovetail::fem {
namespace {

using testing::Grid;
const std::vector<Material> kTitanium{Material{}};

Grid distorted_grid() {
  Grid grid = testing::make_grid(3, 4, testing::rectangle(0.3, 0.4, 0.1, 0.2));
  testing::distort(grid, 0.02, 1);
  return grid;
}

TEST(Assembler, SumsTheElementMatrices) {
  const Grid grid = distorted_grid();
  const Assembler assembler(grid.mesh);
  const FullMatrices full = assembler.stiffness_and_mass(grid.mesh, kTitanium);
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(full.stiffness.rows(), full.stiffness.cols());
  Eigen::MatrixXd mass = stiffness;
  ElementMatrix<Triangle6> ke;
  ScalarMatrix<Triangle6> me;
  for (int e = 0; e < grid.mesh.element_count(); ++e) {
    stiffness_and_mass<Triangle6>(element_nodes<Triangle6>(grid.mesh, e), lame<Triangle6>(kTitanium[0]),
                                  kTitanium[0].density, 1.0, ke, me);
    for (int i = 0; i < 12; ++i)
      for (int j = 0; j < 12; ++j) {
        const int row = 2 * grid.mesh.element(e)[static_cast<std::size_t>(i / 2)] + i % 2;
        const int column = 2 * grid.mesh.element(e)[static_cast<std::size_t>(j / 2)] + j % 2;
        stiffness(row, column) += ke(i, j);
        if (i % 2 == j % 2) mass(row, column) += me(i / 2, j / 2);
      }
  }
  EXPECT_EQ(Eigen::MatrixXd(full.stiffness), stiffness);
  EXPECT_EQ(Eigen::MatrixXd(full.mass), mass);
}

TEST(Assembler, FillsTheSamePatternAfterNodesMoved) {
  Grid grid = distorted_grid();
  const Assembler assembler(grid.mesh);
  testing::curve_edges(grid, 0.004, 3);
  const FullMatrices moved = assembler.stiffness_and_mass(grid.mesh, kTitanium);
  const FullMatrices fresh = Assembler(grid.mesh).stiffness_and_mass(grid.mesh, kTitanium);
  EXPECT_EQ(Eigen::MatrixXd(moved.stiffness), Eigen::MatrixXd(fresh.stiffness));
  EXPECT_EQ(moved.stiffness.nonZeros(), fresh.stiffness.nonZeros());
  EXPECT_EQ(Eigen::MatrixXd(moved.mass), Eigen::MatrixXd(fresh.mass));
  EXPECT_TRUE(assembler.serves(grid.mesh));
  std::swap(grid.mesh.connectivity[0], grid.mesh.connectivity[1]);
  EXPECT_FALSE(assembler.serves(grid.mesh));
  EXPECT_FALSE(assembler.serves(testing::make_grid(4, 3, testing::rectangle(0.3, 0.4)).mesh));
}

TEST(Assembler, ScalesEachRegionByItsThicknessAndMaterial) {
  Grid grid = distorted_grid();
  grid.mesh.regions = {{.name = "thin", .body = 0, .thickness = 0.1}, {.name = "thick", .body = 1, .thickness = 0.5}};
  for (std::size_t e = 0; e < grid.mesh.region.size(); ++e) grid.mesh.region[e] = e % 2 == 0 ? 0 : 1;
  const std::vector<Material> two{{.density = 1000}, {.density = 3000}};
  const Assembler assembler(grid.mesh);
  const Eigen::SparseMatrix<double> mass = assembler.stiffness_and_mass(grid.mesh, two).mass;
  Eigen::VectorXd along_x = Eigen::VectorXd::Zero(mass.rows());
  for (int i = 0; i < along_x.size(); i += 2) along_x[i] = 1;
  const double expected = body_mass(grid.mesh, two, 0) + body_mass(grid.mesh, two, 1);
  EXPECT_NEAR(along_x.dot(mass * along_x), expected, 1e-13 * expected);
  grid.mesh.regions[0].thickness *= 2;
  EXPECT_NEAR(body_mass(grid.mesh, two, 0) + body_mass(grid.mesh, two, 1) - expected, body_mass(grid.mesh, two, 0) / 2,
              1e-13 * expected);
}

TEST(Assembler, RefusesWhatCannotBeAssembled) {
  Grid grid = distorted_grid();
  const Assembler assembler(grid.mesh);
  Mesh inverted = grid.mesh;
  inverted.nodes.col(grid.node(2, 2)) = Eigen::Vector2d(5, 5);
  EXPECT_THROW((void)assembler.stiffness_and_mass(inverted, kTitanium), InputError);
  Mesh thin = grid.mesh;
  thin.regions[0].thickness = 0;
  EXPECT_THROW(Assembler{thin}, InputError);
  Mesh dangling = grid.mesh;
  dangling.connectivity[3] = dangling.node_count();
  EXPECT_THROW(Assembler{dangling}, InputError);
  const std::vector<Material> incompressible{{.poisson_ratio = 0.5}};
  EXPECT_THROW((void)assembler.stiffness_and_mass(grid.mesh, incompressible), InputError);
}

TEST(CentrifugalLoad, TotalsMassTimesCentroidOfTheBody) {
  // The resultant is the integral of rho r dA; an undistorted rectangle has its centroid in the middle.
  const Grid grid = testing::make_grid(3, 4, testing::rectangle(0.3, 0.4, 0.1, 0.2));
  const FullMatrices full = Assembler(grid.mesh).stiffness_and_mass(grid.mesh, kTitanium);
  const Eigen::VectorXd load = centrifugal_load(full.mass, grid.mesh);
  const double mass = 4430 * 0.3 * 0.4;
  const Eigen::Vector2d total = load.reshaped(2, load.size() / 2).rowwise().sum();
  EXPECT_NEAR(total.x(), mass * 0.25, 1e-13 * mass);
  EXPECT_NEAR(total.y(), mass * 0.4, 1e-13 * mass);
}

// A linear displacement is in the space of curved isoparametric elements too; the quadrature integrates
// grad N (degree 2 after multiplying by the Jacobian) exactly, so inner nodes find it to rounding.
TEST(PatchTest, LinearDisplacementOnDistortedCurvedElements) {
  Grid grid = testing::make_grid(4, 3, testing::rectangle(1, 1));
  testing::distort(grid, 0.06, 2);
  testing::curve_edges(grid, 0.015, 4);
  const FullMatrices full = Assembler(grid.mesh).stiffness_and_mass(grid.mesh, kTitanium);
  Eigen::Matrix2d gradient;
  gradient << 1e-3, 4e-4, -7e-4, 2e-3;
  const Eigen::VectorXd exact = (gradient * grid.mesh.nodes).reshaped();
  const Eigen::VectorXd u =
      testing::solve_held(full.stiffness, Eigen::VectorXd::Zero(exact.size()), testing::outline_dofs(grid), exact);
  EXPECT_LT((u - exact).cwiseAbs().maxCoeff(), 1e-12 * exact.cwiseAbs().maxCoeff());
  const StressField stress = quadrature_stress(grid.mesh, kTitanium, u);
  const Eigen::Vector3d expected = elasticity<Triangle6>(kTitanium[0]) *
                                   Eigen::Vector3d(gradient(0, 0), gradient(1, 1), gradient(0, 1) + gradient(1, 0));
  EXPECT_LT((stress.colwise() - expected).cwiseAbs().maxCoeff(), 1e-11 * expected.norm());
}

// A quadratic displacement needs straight sides (only then are x^2, xy, y^2 in the space) and its constant body force.
TEST(PatchTest, QuadraticDisplacementOnDistortedStraightElements) {
  Grid grid = testing::make_grid(4, 3, testing::rectangle(1, 1));
  testing::distort(grid, 0.06, 5);
  const Material material{.youngs_modulus = 1, .poisson_ratio = 0.3, .density = 1};
  const std::vector<Material> materials{material};
  const FullMatrices full = Assembler(grid.mesh).stiffness_and_mass(grid.mesh, materials);
  const Eigen::Index n = grid.mesh.nodes.cols();
  Eigen::VectorXd exact(2 * n), body(2 * n);
  const Eigen::Matrix3d d = elasticity<Triangle6>(material);
  for (Eigen::Index k = 0; k < n; ++k) {
    const double x = grid.mesh.nodes(0, k), y = grid.mesh.nodes(1, k);
    exact.segment<2>(2 * k) << x * x + 2 * x * y - y * y, 3 * x * y + y * y - 0.5 * x * x;
    // eps = (2x + 2y, 3x + 2y, 2x - 2y + 3y - x): b = -div sigma.
    body.segment<2>(2 * k) << -(d(0, 0) * 2 + d(0, 1) * 3 + d(2, 2) * 1), -(d(0, 1) * 2 + d(1, 1) * 2 + d(2, 2) * 1);
  }
  const Eigen::VectorXd u = testing::solve_held(full.stiffness, full.mass * body, testing::outline_dofs(grid), exact);
  EXPECT_LT((u - exact).cwiseAbs().maxCoeff(), 1e-12 * exact.cwiseAbs().maxCoeff());
}

// u = (xy, (x^2 - y^2)/2) has sigma = 2G (y, -y, x), free of body force.
TEST(PatchTest, QuadraticDisplacementNeedsStraightSides) {
  Grid grid = testing::make_grid(4, 3, testing::rectangle(1, 1));
  const std::vector<Material> materials{{.youngs_modulus = 1}};
  const auto error = [&] {
    const FullMatrices full = Assembler(grid.mesh).stiffness_and_mass(grid.mesh, materials);
    Eigen::VectorXd exact(2 * grid.mesh.nodes.cols());
    for (Eigen::Index k = 0; k < grid.mesh.nodes.cols(); ++k) {
      const double x = grid.mesh.nodes(0, k), y = grid.mesh.nodes(1, k);
      exact.segment<2>(2 * k) << x * y, 0.5 * (x * x - y * y);
    }
    const Eigen::VectorXd none = Eigen::VectorXd::Zero(exact.size());
    const Eigen::VectorXd u = testing::solve_held(full.stiffness, none, testing::outline_dofs(grid), exact);
    return (u - exact).cwiseAbs().maxCoeff();
  };
  EXPECT_LT(error(), 1e-13);
  testing::curve_edges(grid, 0.03, 6);
  EXPECT_GT(error(), 1e-6);
}

}  // namespace
}  // namespace dovetail::fem
