#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>
#include <numeric>

#include "core/errors.hpp"
#include "fem/assembly.hpp"
#include "fem/element.hpp"
#include "fem/neck.hpp"
#include "fem/stress.hpp"
#include "fem/stress_aggregate.hpp"
#include "numerics/dense_symmetric.hpp"
#include "tests/unit/fem/extruded_mesh.hpp"
#include "tests/unit/fem/structured_mesh.hpp"

namespace dovetail::fem {
namespace {

const std::vector<Material> kTitanium{Material{}};
constexpr double kHeight = 0.6;

Mesh box(int columns, int rows, int layers, double shaken) {
  Mesh mesh = testing::extrude(testing::make_grid(columns, rows, testing::rectangle(1, 1)).mesh, layers, kHeight);
  testing::shake(mesh, shaken, kHeight, 11);
  return mesh;
}

std::vector<int> surface_dofs(const Mesh& mesh) {
  std::vector<int> dofs;
  for (int k = 0; k < mesh.node_count(); ++k) {
    const Eigen::Vector3d x = mesh.nodes.col(k);
    if (x.minCoeff() < 1e-9 || x.x() > 1 - 1e-9 || x.y() > 1 - 1e-9 || x.z() > kHeight - 1e-9)
      for (int c = 0; c < 3; ++c) dofs.push_back(3 * k + c);
  }
  return dofs;
}

// integral of xi^i eta^j zeta^k over the wedge is i! j! / (i + j + 2)! times 2 / (k + 1) for even k.
TEST(WedgeQuadrature, IsExactToDegreesFourAndFive) {
  for (int i = 0; i <= 4; ++i)
    for (int j = 0; i + j <= 4; ++j)
      for (int k = 0; k <= 5; ++k) {
        double sum = 0;
        for (const QuadraturePoint<3>& p : Wedge18::quadrature())
          sum += p.weight * std::pow(p.local[0], i) * std::pow(p.local[1], j) * std::pow(p.local[2], k);
        const double plane = std::tgamma(i + 1) * std::tgamma(j + 1) / std::tgamma(i + j + 3);
        EXPECT_NEAR(sum, k % 2 == 0 ? plane * 2 / (k + 1) : 0, 1e-15) << i << j << k;
      }
}

class CurvedWedge : public ::testing::Test {
 protected:
  CurvedWedge() {
    const Mesh mesh = [] {
      Mesh curved = box(1, 1, 1, 0);
      for (int k = 0; k < curved.node_count(); ++k) {
        const Eigen::Vector3d x = curved.nodes.col(k);
        curved.nodes.col(k) += Eigen::Vector3d(0.1 * x.y() * x.z(), 0.15 * x.z() * x.z(), 0.1 * x.x() * x.y());
      }
      return curved;
    }();
    nodes = element_nodes<Wedge18>(mesh, 0);
    smallest = stiffness_and_mass<Wedge18>(nodes, lame<Wedge18>({}), 4430, 1, stiffness, mass);
  }
  ElementNodes<Wedge18> nodes;
  ElementMatrix<Wedge18> stiffness;
  ScalarMatrix<Wedge18> mass;
  double smallest = 0;
};

TEST_F(CurvedWedge, HasSixRigidModesAndNoOthers) {
  EXPECT_GT(smallest, 0);
  Eigen::Matrix<double, 54, 6> rigid = Eigen::Matrix<double, 54, 6>::Zero();
  for (int a = 0; a < 18; ++a)
    for (int c = 0; c < 3; ++c) {
      rigid(3 * a + c, c) = 1;
      rigid.block<3, 1>(3 * a, 3 + c) = Eigen::Vector3d::Unit(c).cross(Eigen::Vector3d(nodes.col(a)));
    }
  // Rounding of sums of 54 terms of the size of the largest entry.
  EXPECT_LT((stiffness * rigid).cwiseAbs().maxCoeff(), 1e-13 * stiffness.cwiseAbs().maxCoeff());
  const Eigen::VectorXd values = numerics::all_values<double>(stiffness).values;
  EXPECT_LT(values.head(6).cwiseAbs().maxCoeff(), 1e-13 * values[53]);
  EXPECT_GT(values[6], 1e-5 * values[53]);
}

TEST_F(CurvedWedge, IsTheWorkOfStressesOnStrains) {
  ElementMatrix<Wedge18> work = ElementMatrix<Wedge18>::Zero();
  Eigen::Matrix<double, Wedge18::kStresses, kElementDofs<Wedge18>> strain = decltype(strain)::Zero();
  for (const auto& point : Wedge18::quadrature()) {
    const SpatialGradients<Wedge18> space = spatial_gradients<Wedge18>(nodes, point.local);
    fill_strain<Wedge18>(space.gradients, strain);
    work += point.weight * space.determinant * strain.transpose() * elasticity<Wedge18>({}) * strain;
  }
  EXPECT_LT((stiffness - work).cwiseAbs().maxCoeff(), 1e-14 * work.cwiseAbs().maxCoeff());
}

TEST_F(CurvedWedge, IsSymmetricToTheLastBit) {
  EXPECT_EQ(stiffness, ElementMatrix<Wedge18>(stiffness.transpose()));
  EXPECT_EQ(mass, ScalarMatrix<Wedge18>(mass.transpose()));
}

TEST_F(CurvedWedge, GeometricStiffnessIsTheWorkOfTheStress) {
  // A uniform stress and the displacement u = A x: integral of sigma_ij u_k,i u_k,j = volume tr(A sigma A^T).
  PointStress<Wedge18> stress;
  Eigen::Matrix<double, 6, 1> components;
  components << 3e6, -1e6, 2e6, 5e5, -7e5, 9e5;
  stress.colwise() = components;
  ScalarMatrix<Wedge18> geometric;
  geometric_stiffness<Wedge18>(nodes, stress, 1, geometric);
  Eigen::Matrix3d a, sigma;
  a << 0.3, -0.2, 0.7, 0.5, 0.1, -0.4, 0.2, 0.6, -0.3;
  sigma << 3e6, 5e5, 9e5, 5e5, -1e6, -7e5, 9e5, -7e5, 2e6;
  const Eigen::Matrix<double, 3, 18> u = a * nodes;
  const double expected = mass.sum() / 4430 * (a * sigma * a.transpose()).trace();
  EXPECT_NEAR((u * geometric * u.transpose()).trace(), expected, 1e-12 * std::abs(expected));
}

TEST(SpaceElasticity, InvertsToItsCompliance) {
  const Material m{.youngs_modulus = 2e11, .poisson_ratio = 0.3, .density = 1};
  Eigen::Matrix<double, 6, 6> compliance = Eigen::Matrix<double, 6, 6>::Zero();
  compliance.topLeftCorner<3, 3>().setConstant(-0.3);
  compliance.diagonal() << 1, 1, 1, 2.6, 2.6, 2.6;
  EXPECT_LT((elasticity<Wedge18>(m) * compliance / 2e11 - Eigen::Matrix<double, 6, 6>::Identity()).norm(), 1e-14);
}

TEST(SpaceAssembler, SumsTheElementMatrices) {
  const Mesh mesh = box(2, 1, 2, 0.03);
  const FullMatrices full = Assembler(mesh).stiffness_and_mass(mesh, kTitanium);
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(full.stiffness.rows(), full.stiffness.cols());
  Eigen::MatrixXd mass = stiffness;
  ElementMatrix<Wedge18> ke;
  ScalarMatrix<Wedge18> me;
  for (int e = 0; e < mesh.element_count(); ++e) {
    stiffness_and_mass<Wedge18>(element_nodes<Wedge18>(mesh, e), lame<Wedge18>(kTitanium[0]), kTitanium[0].density, 1.0,
                                ke, me);
    for (int i = 0; i < 54; ++i)
      for (int j = 0; j < 54; ++j) {
        const int row = 3 * mesh.element(e)[static_cast<std::size_t>(i / 3)] + i % 3;
        const int column = 3 * mesh.element(e)[static_cast<std::size_t>(j / 3)] + j % 3;
        stiffness(row, column) += ke(i, j);
        if (i % 3 == j % 3) mass(row, column) += me(i / 3, j / 3);
      }
  }
  EXPECT_EQ(Eigen::MatrixXd(full.stiffness), stiffness);
  EXPECT_EQ(Eigen::MatrixXd(full.mass), mass);
}

TEST(SpaceAssembler, KnowsMassAndCentreOfMass) {
  // Bent edges inside the box leave its volume alone, which is integrated exactly; first moments need straight edges.
  const double mass = 4430 * kHeight;
  EXPECT_NEAR(body_mass(box(3, 2, 2, 0.03), kTitanium, 0), mass, 1e-13 * mass);
  const Mesh mesh = box(3, 2, 2, 0);
  const FullMatrices full = Assembler(mesh).stiffness_and_mass(mesh, kTitanium);
  const Eigen::VectorXd load = centrifugal_load(full.mass, mesh);
  const Eigen::Vector3d total = load.reshaped(3, load.size() / 3).rowwise().sum();
  EXPECT_NEAR(total.x(), mass / 2, 1e-12 * mass);
  EXPECT_NEAR(total.y(), mass / 2, 1e-12 * mass);
  EXPECT_EQ(total.z(), 0);
}

TEST(SpaceAssembler, RefusesCoordinatesOfTheOtherKind) {
  Mesh mesh = box(1, 1, 1, 0);
  mesh.nodes.conservativeResize(2, Eigen::NoChange);
  EXPECT_THROW(Assembler{mesh}, InputError);
}

// As in the plane: a linear displacement is in the space of curved wedges, and the quadrature integrates grad N exactly
// (degree 4 in the triangle, 5 along).
TEST(SpacePatchTest, LinearDisplacementOnDistortedCurvedWedges) {
  const Mesh mesh = box(3, 3, 2, 0.03);
  const FullMatrices full = Assembler(mesh).stiffness_and_mass(mesh, kTitanium);
  Eigen::Matrix3d gradient;
  gradient << 1e-3, 4e-4, -2e-4, -7e-4, 2e-3, 3e-4, 5e-4, -6e-4, -1e-3;
  const Eigen::VectorXd exact = (gradient * mesh.nodes).reshaped();
  const Eigen::VectorXd u =
      testing::solve_held(full.stiffness, Eigen::VectorXd::Zero(exact.size()), surface_dofs(mesh), exact);
  EXPECT_LT((u - exact).cwiseAbs().maxCoeff(), 1e-12 * exact.cwiseAbs().maxCoeff());
  Eigen::Matrix<double, 6, 1> strain;
  strain << gradient(0, 0), gradient(1, 1), gradient(2, 2), gradient(0, 1) + gradient(1, 0),
      gradient(1, 2) + gradient(2, 1), gradient(2, 0) + gradient(0, 2);
  const Eigen::Matrix<double, 6, 1> expected = elasticity<Wedge18>(kTitanium[0]) * strain;
  const StressField stress = quadrature_stress(mesh, kTitanium, u);
  EXPECT_LT((stress.colwise() - Eigen::VectorXd(expected)).cwiseAbs().maxCoeff(), 1e-11 * expected.norm());
  std::vector<int> nodes(static_cast<std::size_t>(mesh.node_count()));
  std::iota(nodes.begin(), nodes.end(), 0);
  const Eigen::VectorXd nodal = nodal_stress_operator(mesh, kTitanium, nodes) * u;
  for (Eigen::Index k = 0; k < mesh.nodes.cols(); ++k)
    EXPECT_LT((nodal.segment<6>(6 * k) - expected).norm(), 1e-11 * expected.norm());
}

// With straight sides x^2, xy, ... are in the space too (mass: the constant body force of that displacement).
TEST(SpacePatchTest, QuadraticDisplacementOnStraightWedges) {
  const Mesh mesh = box(3, 2, 2, 0);
  const std::vector<Material> materials{{.youngs_modulus = 1, .poisson_ratio = 0.3, .density = 1}};
  const FullMatrices full = Assembler(mesh).stiffness_and_mass(mesh, materials);
  const double lame = 0.3 / (1.3 * 0.4), shear = 1 / 2.6;
  const Eigen::Index n = mesh.nodes.cols();
  Eigen::VectorXd exact(3 * n), body(3 * n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const Eigen::Vector3d x = mesh.nodes.col(k);
    exact.segment<3>(3 * k) << x[0] * x[0] + 2 * x[1] * x[2], x[1] * x[1] - x[0] * x[2], 3 * x[2] * x[2] + x[0] * x[1];
    // div u = 2x + 2y + 6z, laplacian u = (2, 2, 6): -div sigma = -(lame + shear) grad div u - shear laplacian u.
    body.segment<3>(3 * k) = -(lame + 2 * shear) * Eigen::Vector3d(2, 2, 6);
  }
  const Eigen::VectorXd u = testing::solve_held(full.stiffness, full.mass * body, surface_dofs(mesh), exact);
  EXPECT_LT((u - exact).cwiseAbs().maxCoeff(), 1e-12 * exact.cwiseAbs().maxCoeff());
}

TEST(VonMisesInSpace, KnowsItsStatesAndItsGradient) {
  Eigen::VectorXd s(6);
  s << 5, 0, 0, 0, 0, 0;
  EXPECT_DOUBLE_EQ(von_mises(s, 0), 5);
  s << 0, 0, 0, 0, 5, 0;
  EXPECT_DOUBLE_EQ(von_mises(s, 0), 5 * std::sqrt(3.0));
  s << 7, 7, 7, 0, 0, 0;
  EXPECT_NEAR(von_mises(s, 0), 0, 1e-14);
}

TEST(SurfaceWeights, SumToTheAreaOfTheCylinder) {
  // Simpson's rule on parabolic faces: the error falls like h^4.
  double previous = 0;
  for (int rows : {4, 8}) {
    const testing::Grid grid = testing::make_grid(1, rows, testing::annular_sector(0.1, 0.2, 6));
    const Mesh mesh = testing::extrude(grid.mesh, 2, kHeight);
    std::vector<int> nodes;
    for (int l = 0; l < 5; ++l)
      for (int j = 0; j <= 2 * rows; ++j) nodes.push_back(grid.node(2, j) + grid.mesh.node_count() * l);
    const Eigen::VectorXd weights = boundary_weights(mesh, nodes);
    EXPECT_GT(weights.minCoeff(), 0);
    const double error = weights.sum() - 0.2 * 2 * std::numbers::pi / 6 * kHeight;
    if (previous != 0) {
      EXPECT_LT(std::abs(error), std::abs(previous) / 12);
    }
    previous = error;
  }
}

TEST(SurfaceWeights, IntegrateQuadraticsOnTwistedFaces) {
  // The plane x = 1 of the box, its inner nodes shifted within it: the integral of a bilinear function of y and z
  // must not change. |dr x dr| times it is of degree 3 in each local coordinate, which Simpson's rule integrates.
  const testing::Grid grid = testing::make_grid(1, 2, testing::rectangle(1, 1));
  Mesh mesh = testing::extrude(grid.mesh, 2, kHeight, [](const Eigen::Vector2d& p, double z) {
    return Eigen::Vector3d(p.x(), p.y() + 0.2 * z * p.y() * (1 - p.y()), z);
  });
  std::vector<int> nodes;
  double integral = 0;
  for (int k = 0; k < mesh.node_count(); ++k)
    if (mesh.nodes(0, k) == 1) nodes.push_back(k);
  const Eigen::VectorXd weights = boundary_weights(mesh, nodes);
  for (std::size_t k = 0; k < nodes.size(); ++k)
    integral += weights[static_cast<Eigen::Index>(k)] * (1 + mesh.nodes(1, nodes[k]) * mesh.nodes(2, nodes[k]));
  EXPECT_NEAR(integral, kHeight + kHeight * kHeight / 4, 1e-3 * integral);
  EXPECT_NEAR(weights.sum(), kHeight, 1e-13);
}

TEST(NeckTensionInSpace, IsTheCentrifugalPullOfWhatIsAbove) {
  // A column as in the plane, 0.03 long, its section at corners and inside elements.
  const testing::Grid grid = testing::make_grid(2, 8, testing::rectangle(0.02, 0.4, -0.01, 0.1));
  const Mesh mesh = testing::extrude(grid.mesh, 2, 0.03);
  for (int j : {4, 5}) {
    SectorMesh sector;
    sector.mesh = mesh;
    const int level = 2 * grid.mesh.node_count();
    sector.neck_nodes = {grid.node(0, 2) + level, grid.node(4, 2) + level, grid.node(0, j) + level,
                         grid.node(4, j) + level};
    const NeckTension neck = neck_tension(sector, kTitanium);
    const double h = 0.1 + 0.4 * j / 16, mass = 4430 * 0.03 * 0.02 * (0.5 - h);
    EXPECT_NEAR(neck.mass, mass, 1e-13 * mass);
    EXPECT_NEAR(neck.tension, mass * (0.5 + h) / 2, 1e-13 * mass);
    EXPECT_NEAR(neck.force.x(), 0, 1e-14 * mass);
    EXPECT_NEAR(neck.thickness, 0.03, 1e-12);
    EXPECT_NEAR(neck.mean_stress, neck.tension / (0.02 * 0.03), 1e-9 * neck.mean_stress);
  }
}

}  // namespace
}  // namespace dovetail::fem
