#include "fem/element.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>

#include "tests/unit/fem/structured_mesh.hpp"

namespace dovetail::fem {
namespace {

double factorial(int n) {
  return std::tgamma(n + 1.0);
}

// integral of xi^i eta^j over the unit triangle is i! j! / (i + j + 2)!.
TEST(Quadrature, IsExactToDegreeFour) {
  for (int i = 0; i <= 4; ++i)
    for (int j = 0; i + j <= 4; ++j) {
      double sum = 0;
      for (const QuadraturePoint& p : quadrature()) sum += p.weight * std::pow(p.xi, i) * std::pow(p.eta, j);
      // Tabulated to 18 digits, so rounding only.
      EXPECT_NEAR(sum, factorial(i) * factorial(j) / factorial(i + j + 2), 1e-16) << i << " " << j;
    }
}

TEST(ShapeFunctions, AreOneAtTheirNodeAndZeroAtTheOthers) {
  for (int a = 0; a < 6; ++a) {
    const Eigen::Vector2d local = node_coordinates(a);
    const Eigen::Matrix<double, 6, 1> n = shape_functions(local.x(), local.y());
    for (int b = 0; b < 6; ++b) EXPECT_NEAR(n[b], a == b ? 1 : 0, 1e-15);
  }
}

TEST(ShapeFunctions, GradientsAreTheirDerivatives) {
  // Central differences of quadratics are exact up to rounding 1e-16 / step.
  const double xi = 0.23, eta = 0.41, step = 1e-3;
  const ElementGradients g = local_gradients(xi, eta);
  const Eigen::Matrix<double, 6, 1> dxi =
      (shape_functions(xi + step, eta) - shape_functions(xi - step, eta)) / (2 * step);
  const Eigen::Matrix<double, 6, 1> deta =
      (shape_functions(xi, eta + step) - shape_functions(xi, eta - step)) / (2 * step);
  EXPECT_LT((g.col(0) - dxi).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((g.col(1) - deta).cwiseAbs().maxCoeff(), 1e-12);
}

class CurvedElement : public ::testing::Test {
 protected:
  CurvedElement() {
    nodes << 0.1, 1.2, 0.3, 0.62, 0.83, 0.17,  //
        0.0, 0.1, 0.9, -0.07, 0.58, 0.47;
    smallest = stiffness_and_mass(nodes, elasticity({}, false), 4430, 0.04, stiffness, mass);
  }
  ElementNodes nodes;
  ElementMatrix stiffness, mass;
  double smallest = 0;
};

TEST_F(CurvedElement, RigidMotionsCarryNoForce) {
  EXPECT_GT(smallest, 0);
  Eigen::Matrix<double, 12, 3> rigid = Eigen::Matrix<double, 12, 3>::Zero();
  for (int a = 0; a < 6; ++a) {
    rigid(2 * a, 0) = 1;
    rigid(2 * a + 1, 1) = 1;
    rigid(2 * a, 2) = -nodes(1, a);
    rigid(2 * a + 1, 2) = nodes(0, a);
  }
  // Rounding of sums of 12 terms of the size of the largest entry.
  EXPECT_LT((stiffness * rigid).cwiseAbs().maxCoeff(), 1e-14 * stiffness.cwiseAbs().maxCoeff());
}

TEST_F(CurvedElement, HasThreeRigidModesAndNoOthers) {
  const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<ElementMatrix>(stiffness).eigenvalues();
  EXPECT_LT(values.head(3).cwiseAbs().maxCoeff(), 1e-13 * values[11]);
  EXPECT_GT(values[3], 1e-4 * values[11]);
}

TEST_F(CurvedElement, IsSymmetricToTheLastBit) {
  EXPECT_EQ(stiffness, ElementMatrix(stiffness.transpose()));
  EXPECT_EQ(mass, ElementMatrix(mass.transpose()));
}

TEST_F(CurvedElement, MassSumsToDensityTimesVolume) {
  // Green's formula on the three parabolic edges, by Simpson's rule applied to x dy (exact: cubic integrand).
  double area = 0;
  constexpr std::array<std::array<int, 3>, 3> edges{{{0, 3, 1}, {1, 4, 2}, {2, 5, 0}}};
  for (const std::array<int, 3>& edge : edges) {
    const Eigen::Vector2d a = nodes.col(edge[0]), m = nodes.col(edge[1]), b = nodes.col(edge[2]);
    area += (a.x() * (-3 * a + 4 * m - b).y() + 4 * m.x() * (b - a).y() + b.x() * (a - 4 * m + 3 * b).y()) / 6;
  }
  double total = 0;
  for (int a = 0; a < 6; ++a)
    for (int b = 0; b < 6; ++b) total += mass(2 * a, 2 * b);
  EXPECT_NEAR(total, 4430 * 0.04 * area, 1e-13 * total);
}

TEST_F(CurvedElement, GeometricStiffnessIsTheWorkOfTheStress) {
  // A uniform stress and the displacement u = A x: integral of sigma_ij u_k,i u_k,j = area t tr(A sigma A^T).
  Eigen::Matrix<double, 3, 6> stress;
  stress.colwise() = Eigen::Vector3d(3e6, -1e6, 2e6);
  ElementMatrix geometric;
  geometric_stiffness(nodes, stress, 0.04, geometric);
  Eigen::Matrix2d a, sigma;
  a << 0.3, -0.2, 0.7, 0.5;
  sigma << 3e6, 2e6, 2e6, -1e6;
  Eigen::Matrix<double, 12, 1> u;
  for (int k = 0; k < 6; ++k) u.segment<2>(2 * k) = a * nodes.col(k);
  double volume = 0;
  for (int i = 0; i < 12; i += 2)
    for (int j = 0; j < 12; j += 2) volume += mass(i, j) / 4430;
  const double expected = volume * (a * sigma * a.transpose()).trace();
  EXPECT_NEAR(u.dot(geometric * u), expected, 1e-13 * std::abs(expected));
}

TEST(Elasticity, PlaneStressAndPlaneStrainInvertToTheirCompliances) {
  const Material m{.youngs_modulus = 2e11, .poisson_ratio = 0.3, .density = 1};
  const double e = m.youngs_modulus, nu = m.poisson_ratio;
  Eigen::Matrix3d stress_compliance, strain_compliance;
  stress_compliance << 1, -nu, 0, -nu, 1, 0, 0, 0, 2 * (1 + nu);
  strain_compliance << 1 - nu * nu, -nu * (1 + nu), 0, -nu * (1 + nu), 1 - nu * nu, 0, 0, 0, 2 * (1 + nu);
  EXPECT_LT((elasticity(m, true) * stress_compliance / e - Eigen::Matrix3d::Identity()).norm(), 1e-14);
  EXPECT_LT((elasticity(m, false) * strain_compliance / e - Eigen::Matrix3d::Identity()).norm(), 1e-14);
}

TEST(StiffnessAndMass, ReportsAnInvertedElement) {
  ElementNodes nodes;
  nodes << 0, 0, 1, 0, 0.5, 0.5, 0, 1, 0, 0.5, 0.5, 0;  // clockwise
  ElementMatrix stiffness, mass;
  EXPECT_LT(stiffness_and_mass(nodes, elasticity({}, false), 1, 1, stiffness, mass), 0);
}

}  // namespace
}  // namespace dovetail::fem
