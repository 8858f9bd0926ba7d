#include "fem/stress.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <numbers>
#include <numeric>

#include "core/errors.hpp"
#include "fem/element.hpp"
#include "fem/neck.hpp"
#include "fem/stress_aggregate.hpp"
#include "tests/unit/fem/structured_mesh.hpp"

namespace dovetail::fem {
namespace {

using testing::Grid;

TEST(NodalStress, IsExactForUniformStrainOnCurvedElements) {
  Grid grid = testing::make_grid(3, 3, testing::annular_sector(0.1, 0.2, 8));
  testing::curve_edges(grid, 0.002, 1);
  const std::vector<Material> materials{Material{}};
  Eigen::Matrix2d gradient;
  gradient << 1e-3, 2e-3, -5e-4, 7e-4;
  const Eigen::VectorXd u = (gradient * grid.mesh.nodes).reshaped();
  std::vector<int> nodes{grid.node(6, 6), grid.node(2, 2), grid.node(3, 2), grid.node(0, 1)};
  const Eigen::VectorXd stress = nodal_stress_operator(grid.mesh, materials, nodes) * u;
  const Eigen::Vector3d expected = elasticity<Triangle6>(materials[0]) * Eigen::Vector3d(1e-3, 7e-4, 1.5e-3);
  for (Eigen::Index k = 0; k < 4; ++k) EXPECT_LT((stress.segment<3>(3 * k) - expected).norm(), 1e-12 * expected.norm());
}

TEST(NodalStress, AgreesWithQuadraturePointsForLinearStress) {
  // u = (x^2, xy): strains are linear, straight elements reproduce them anywhere.
  const Grid grid = testing::make_grid(3, 2, testing::rectangle(1, 1));
  const std::vector<Material> materials{Material{}};
  Eigen::VectorXd u(2 * grid.mesh.nodes.cols());
  for (Eigen::Index k = 0; k < grid.mesh.nodes.cols(); ++k) {
    const Eigen::Vector2d p = grid.mesh.nodes.col(k);
    u.segment<2>(2 * k) << p.x() * p.x(), p.x() * p.y();
  }
  const Eigen::Matrix3d d = elasticity<Triangle6>(materials[0]);
  const auto exact = [&](const Eigen::Vector2d& p) {
    return Eigen::Vector3d(d * Eigen::Vector3d(2 * p.x(), p.x(), p.y()));
  };
  std::vector<int> nodes(static_cast<std::size_t>(grid.mesh.node_count()));
  std::iota(nodes.begin(), nodes.end(), 0);
  const Eigen::VectorXd nodal = nodal_stress_operator(grid.mesh, materials, nodes) * u;
  for (int k : nodes) EXPECT_LT((nodal.segment<3>(3 * k) - exact(grid.mesh.nodes.col(k))).norm(), 1e-12 * d.norm());
  const StressField points = quadrature_stress(grid.mesh, materials, u);
  for (int e = 0; e < grid.mesh.element_count(); ++e)
    for (int q = 0; q < Triangle6::kPoints; ++q) {
      const Eigen::Vector2d local = Triangle6::quadrature()[static_cast<std::size_t>(q)].local;
      const Eigen::Vector2d p = element_nodes<Triangle6>(grid.mesh, e) * Triangle6::shape(local);
      EXPECT_LT((points.col(Triangle6::kPoints * e + q) - exact(p)).norm(), 1e-12 * d.norm());
    }
}

TEST(VonMises, KnowsUniaxialShearAndHydrostaticStates) {
  EXPECT_DOUBLE_EQ(von_mises(Eigen::Vector3d(5, 0, 0), 0), 5);
  EXPECT_DOUBLE_EQ(von_mises(Eigen::Vector3d(0, 0, 5), 0.3), 5 * std::sqrt(3.0));
  EXPECT_NEAR(von_mises(Eigen::Vector3d(5, 5, 0), 0.5), 0, 1e-14);  // sigma_zz = 5 too
  // Plane strain, uniaxial: s^2 (1 - nu + nu^2).
  EXPECT_DOUBLE_EQ(von_mises(Eigen::Vector3d(2, 0, 0), 0.3), 2 * std::sqrt(1 - 0.3 + 0.09));
}

std::vector<int> outer_arc(const Grid& grid) {
  std::vector<int> nodes;
  for (int j = 0; j <= 2 * grid.rows; ++j) nodes.push_back(grid.node(2 * grid.columns, j));
  return nodes;
}

// Nothing acts on the surface any more, and the strains along it are those before: for random states.
TEST(FreeSurface, KeepsTheStrainsAlongItAndLosesItsTraction) {
  const double nu = 0.3;
  for (int k = 0; k < 100; ++k) {
    const bool plane = k % 2 == 0;
    const Eigen::Matrix3d random = Eigen::Matrix3d::Random();
    Eigen::Matrix3d before = random + random.transpose(), after;
    Eigen::Vector3d n = Eigen::Vector3d::Random();
    if (plane) {
      n.z() = before(0, 2) = before(2, 0) = before(1, 2) = before(2, 1) = 0;
      before(2, 2) = nu * (before(0, 0) + before(1, 1));
    }
    n.normalize();
    if (plane) {
      const Eigen::VectorXd s =
          on_free_surface(Eigen::Vector3d(before(0, 0), before(1, 1), before(0, 1)), n.head<2>(), nu);
      after << s[0], s[2], 0, s[2], s[1], 0, 0, 0, nu * (s[0] + s[1]);
    } else {
      Eigen::Matrix<double, 6, 1> s;
      s << before(0, 0), before(1, 1), before(2, 2), before(0, 1), before(1, 2), before(2, 0);
      after = stress_tensor<Wedge18>(on_free_surface(s, n, nu));
    }
    EXPECT_LT((after * n).norm(), 1e-12);
    const auto along = [&](const Eigen::Matrix3d& stress) {
      const Eigen::Matrix3d strain = (1 + nu) * stress - nu * stress.trace() * Eigen::Matrix3d::Identity();
      const Eigen::Matrix3d projection = Eigen::Matrix3d::Identity() - n * n.transpose();
      return Eigen::Matrix3d(projection * strain * projection);
    };
    EXPECT_LT((along(after) - along(before)).norm(), 1e-12) << k;
  }
}

TEST(FreeSurface, NormalsOfACircleAreItsRadii) {
  const Grid grid = testing::make_grid(1, 8, testing::annular_sector(0.1, 0.2, 6));
  const std::vector<int> nodes = outer_arc(grid);
  const Eigen::MatrixXd normals = boundary_normals(grid.mesh, nodes);
  for (std::size_t k = 0; k < nodes.size(); ++k)
    EXPECT_NEAR(std::abs(normals.col(static_cast<Eigen::Index>(k)).dot(grid.mesh.nodes.col(nodes[k]).normalized())), 1,
                1e-4)
        << k;
}

TEST(BoundaryWeights, SumToTheLengthOfTheArc) {
  // Simpson's rule on parabolic edges: the error of an arc's length falls like h^4.
  double previous = 0;
  for (int rows : {4, 8}) {
    const Grid grid = testing::make_grid(1, rows, testing::annular_sector(0.1, 0.2, 6));
    const double error = boundary_weights(grid.mesh, outer_arc(grid)).sum() - 0.2 * 2 * std::numbers::pi / 6;
    if (previous != 0) {
      EXPECT_LT(std::abs(error), std::abs(previous) / 12);
    }
    previous = error;
  }
}

TEST(BoundaryWeights, IgnoresEdgesInsideTheBody) {
  const Grid grid = testing::make_grid(2, 2, testing::rectangle(1, 1));
  std::vector<int> column;
  for (int j = 0; j <= 4; ++j) column.push_back(grid.node(2, j));
  EXPECT_THROW((void)boundary_weights(grid.mesh, column), InputError);
}

class AggregateOfAPeak : public ::testing::Test {
 protected:
  // sigma(s) = 300 MPa - 200 MPa (2 s - 1)^2 over the outline's top edge of unit length.
  Aggregate on(int columns, const AggregateOptions& options) {
    const Grid grid = testing::make_grid(columns, 1, testing::rectangle(1, 1));
    std::vector<int> nodes;
    for (int i = 0; i <= 2 * columns; ++i) nodes.push_back(grid.node(i, 2));
    Eigen::VectorXd stress(static_cast<Eigen::Index>(nodes.size()));
    for (Eigen::Index k = 0; k < stress.size(); ++k) {
      const double s = 2 * grid.mesh.nodes(0, nodes[static_cast<std::size_t>(k)]) - 1;
      stress[k] = 300e6 - 200e6 * s * s;
    }
    return kreisselmeier_steinhauser(stress, boundary_weights(grid.mesh, nodes), options);
  }
};

TEST_F(AggregateOfAPeak, ConvergesToItsIntegralWithTheMesh) {
  // integral of exp(-p a (2s-1)^2) ds = sqrt(pi / (p a)) / 2 (the tails beyond the line are exp(-40)).
  const AggregateOptions options{.sharpness = 2e-7, .peak_fraction = 0.1};
  const double exact = 300e6 + std::log(0.5 * std::sqrt(std::numbers::pi / (2e-7 * 200e6)) / 0.1) / 2e-7;
  const double coarse = std::abs(on(16, options).value - exact), fine = std::abs(on(64, options).value - exact);
  EXPECT_LT(fine, 1e3);
  EXPECT_LT(fine, coarse);
}

TEST_F(AggregateOfAPeak, StaysBelowItsBound) {
  for (double fraction : {0.02, 0.1, 1.0}) {
    const Aggregate aggregate = on(32, {.sharpness = 1e-7, .peak_fraction = fraction});
    EXPECT_LE(aggregate.value, aggregate.maximum - std::log(fraction) / 1e-7);
    EXPECT_NEAR(aggregate.gradient.sum(), 1, 1e-14);
    EXPECT_GE(aggregate.gradient.minCoeff(), 0);
  }
}

TEST(Aggregate, ReachesItsBoundForUniformStressAndDoesNotOverflow) {
  const Eigen::VectorXd stress = Eigen::VectorXd::Constant(5, 9e11), weights = Eigen::VectorXd::Ones(5);
  const Aggregate aggregate = kreisselmeier_steinhauser(stress, weights, {.sharpness = 1e-6, .peak_fraction = 0.2});
  EXPECT_NEAR(aggregate.value, 9e11 + std::log(5.0) / 1e-6, 1e-3);
}

TEST(Aggregate, GradientMatchesDifferences) {
  const Eigen::VectorXd stress = Eigen::Vector4d(100e6, 120e6, 90e6, 119e6), weights = Eigen::Vector4d(1, 2, 1, 0.5);
  const Aggregate aggregate = kreisselmeier_steinhauser(stress, weights);
  for (Eigen::Index k = 0; k < 4; ++k) {
    Eigen::VectorXd up = stress, down = stress;
    up[k] += 100;
    down[k] -= 100;
    const double difference =
        (kreisselmeier_steinhauser(up, weights).value - kreisselmeier_steinhauser(down, weights).value) / 200;
    EXPECT_NEAR(aggregate.gradient[k], difference, 1e-8);  // rounding of 1e8 values over a step of 200
  }
}

TEST(NeckTension, IsTheCentrifugalPullOfWhatIsAbove) {
  // A column 0.1 <= y <= 0.5, 0.02 wide: neck between points (at element corners, then inside elements) at y = h.
  Grid grid = testing::make_grid(2, 8, testing::rectangle(0.02, 0.4, -0.01, 0.1));
  grid.mesh.regions[0].thickness = 0.03;
  const std::vector<Material> materials{Material{}};
  for (int j : {4, 5}) {
    SectorMesh sector;
    sector.mesh = grid.mesh;
    sector.neck_nodes = {grid.node(0, 2), grid.node(4, 2), grid.node(0, j), grid.node(4, j)};
    const NeckTension neck = neck_tension(sector, materials);
    const double h = 0.1 + 0.4 * j / 16, mass = 4430 * 0.03 * 0.02 * (0.5 - h);
    EXPECT_NEAR(neck.mass, mass, 1e-13 * mass);
    EXPECT_NEAR(neck.tension, mass * (0.5 + h) / 2, 1e-13 * mass);
    EXPECT_NEAR(neck.force.x(), 0, 1e-14 * mass);
    EXPECT_NEAR(neck.mean_stress, neck.tension / (0.02 * 0.03), 1e-9 * neck.mean_stress);
  }
}

}  // namespace
}  // namespace dovetail::fem
