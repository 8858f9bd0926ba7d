#include "fem/element.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <array>
#include <cmath>

#include "numerics/dense_symmetric.hpp"
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
      for (const QuadraturePoint<2>& p : Triangle6::quadrature())
        sum += p.weight * std::pow(p.local[0], i) * std::pow(p.local[1], j);
      // Tabulated to 18 digits, so rounding only.
      EXPECT_NEAR(sum, factorial(i) * factorial(j) / factorial(i + j + 2), 1e-16) << i << " " << j;
    }
}

template <class Element>
class ShapeFunctions : public ::testing::Test {};
using Elements = ::testing::Types<Triangle6, Wedge18>;
TYPED_TEST_SUITE(ShapeFunctions, Elements);

TYPED_TEST(ShapeFunctions, AreOneAtTheirNodeAndZeroAtTheOthers) {
  for (int a = 0; a < TypeParam::kNodes; ++a) {
    const typename TypeParam::Shape n = TypeParam::shape(TypeParam::node(a));
    for (int b = 0; b < TypeParam::kNodes; ++b) EXPECT_NEAR(n[b], a == b ? 1 : 0, 1e-15);
  }
}

TYPED_TEST(ShapeFunctions, GradientsAreTheirDerivatives) {
  // Central differences of quadratics are exact up to rounding 1e-16 / step.
  typename TypeParam::Point at = TypeParam::Point::Constant(0.23);
  at[1] = 0.41;
  const double step = 1e-3;
  const typename TypeParam::Gradients g = TypeParam::gradients(at);
  for (int c = 0; c < TypeParam::kDimensions; ++c) {
    const typename TypeParam::Point shift = step * TypeParam::Point::Unit(c);
    const typename TypeParam::Shape slope = (TypeParam::shape(at + shift) - TypeParam::shape(at - shift)) / (2 * step);
    EXPECT_LT((g.col(c) - slope).cwiseAbs().maxCoeff(), 1e-12);
  }
}

class CurvedElement : public ::testing::Test {
 protected:
  CurvedElement() {
    nodes << 0.1, 1.2, 0.3, 0.62, 0.83, 0.17,  //
        0.0, 0.1, 0.9, -0.07, 0.58, 0.47;
    smallest = stiffness_and_mass<Triangle6>(nodes, lame<Triangle6>({}), 4430, 0.04, stiffness, mass);
  }
  ElementNodes<Triangle6> nodes;
  ElementMatrix<Triangle6> stiffness;
  ScalarMatrix<Triangle6> mass;
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
  const Eigen::VectorXd values = numerics::all_values<double>(stiffness).values;
  EXPECT_LT(values.head(3).cwiseAbs().maxCoeff(), 1e-13 * values[11]);
  EXPECT_GT(values[3], 1e-4 * values[11]);
}

TEST_F(CurvedElement, IsTheWorkOfStressesOnStrains) {
  ElementMatrix<Triangle6> work = ElementMatrix<Triangle6>::Zero();
  Eigen::Matrix<double, Triangle6::kStresses, kElementDofs<Triangle6>> strain = decltype(strain)::Zero();
  for (const auto& point : Triangle6::quadrature()) {
    const SpatialGradients<Triangle6> space = spatial_gradients<Triangle6>(nodes, point.local);
    fill_strain<Triangle6>(space.gradients, strain);
    work += 0.04 * point.weight * space.determinant * strain.transpose() * elasticity<Triangle6>({}) * strain;
  }
  EXPECT_LT((stiffness - work).cwiseAbs().maxCoeff(), 1e-14 * work.cwiseAbs().maxCoeff());
}

TEST_F(CurvedElement, IsSymmetricToTheLastBit) {
  EXPECT_EQ(stiffness, ElementMatrix<Triangle6>(stiffness.transpose()));
  EXPECT_EQ(mass, ScalarMatrix<Triangle6>(mass.transpose()));
}

TEST_F(CurvedElement, MassSumsToDensityTimesVolume) {
  // Green's formula on the three parabolic edges, by Simpson's rule applied to x dy (exact: cubic integrand).
  double area = 0;
  constexpr std::array<std::array<int, 3>, 3> edges{{{0, 3, 1}, {1, 4, 2}, {2, 5, 0}}};
  for (const std::array<int, 3>& edge : edges) {
    const Eigen::Vector2d a = nodes.col(edge[0]), m = nodes.col(edge[1]), b = nodes.col(edge[2]);
    area += (a.x() * (-3 * a + 4 * m - b).y() + 4 * m.x() * (b - a).y() + b.x() * (a - 4 * m + 3 * b).y()) / 6;
  }
  const double total = mass.sum();
  EXPECT_NEAR(total, 4430 * 0.04 * area, 1e-13 * total);
}

TEST_F(CurvedElement, GeometricStiffnessIsTheWorkOfTheStress) {
  // A uniform stress and the displacement u = A x: integral of sigma_ij u_k,i u_k,j = area t tr(A sigma A^T).
  Eigen::Matrix<double, 3, 6> stress;
  stress.colwise() = Eigen::Vector3d(3e6, -1e6, 2e6);
  ScalarMatrix<Triangle6> geometric;
  geometric_stiffness<Triangle6>(nodes, stress, 0.04, geometric);
  Eigen::Matrix2d a, sigma;
  a << 0.3, -0.2, 0.7, 0.5;
  sigma << 3e6, 2e6, 2e6, -1e6;
  const Eigen::Matrix<double, 2, 6> u = a * nodes;
  const double expected = mass.sum() / 4430 * (a * sigma * a.transpose()).trace();
  EXPECT_NEAR((u * geometric * u.transpose()).trace(), expected, 1e-13 * std::abs(expected));
}

TEST(Elasticity, PlaneStressAndPlaneStrainInvertToTheirCompliances) {
  const Material m{.youngs_modulus = 2e11, .poisson_ratio = 0.3, .density = 1};
  const double e = m.youngs_modulus, nu = m.poisson_ratio;
  Eigen::Matrix3d stress_compliance, strain_compliance;
  stress_compliance << 1, -nu, 0, -nu, 1, 0, 0, 0, 2 * (1 + nu);
  strain_compliance << 1 - nu * nu, -nu * (1 + nu), 0, -nu * (1 + nu), 1 - nu * nu, 0, 0, 0, 2 * (1 + nu);
  EXPECT_LT((elasticity<Triangle6>(m, true) * stress_compliance / e - Eigen::Matrix3d::Identity()).norm(), 1e-14);
  EXPECT_LT((elasticity<Triangle6>(m) * strain_compliance / e - Eigen::Matrix3d::Identity()).norm(), 1e-14);
}

TEST(StiffnessAndMass, ReportsAnInvertedElement) {
  ElementNodes<Triangle6> nodes;
  nodes << 0, 0, 1, 0, 0.5, 0.5, 0, 1, 0, 0.5, 0.5, 0;  // clockwise
  ElementMatrix<Triangle6> stiffness;
  ScalarMatrix<Triangle6> mass;
  EXPECT_LT(stiffness_and_mass<Triangle6>(nodes, lame<Triangle6>({}), 1, 1, stiffness, mass), 0);
}

}  // namespace
}  // namespace dovetail::fem
