#include <gtest/gtest.h>

#include <Eigen/LU>
#include <array>
#include <cmath>

#include "fem/assembly.hpp"
#include "fem/element.hpp"
#include "fem/stress.hpp"
#include "tests/unit/fem/structured_mesh.hpp"

namespace dovetail::fem {
namespace {

// u = (sin ax cos by, c cos ax sin by) with its body force, displacements given on the outline.
using testing::Grid;

struct Manufactured {
  double a = 7, b = 9, c = 0.6;
  Material material{.youngs_modulus = 1, .poisson_ratio = 0.3, .density = 1};

  Eigen::Vector2d displacement(const Eigen::Vector2d& p) const {
    return {std::sin(a * p.x()) * std::cos(b * p.y()), c * std::cos(a * p.x()) * std::sin(b * p.y())};
  }
  Eigen::Vector3d stress(const Eigen::Vector2d& p) const {
    const double cc = std::cos(a * p.x()) * std::cos(b * p.y()), ss = std::sin(a * p.x()) * std::sin(b * p.y());
    return elasticity<Triangle6>(material) * Eigen::Vector3d(a * cc, c * b * cc, -(b + c * a) * ss);
  }
  // -div sigma = -G Laplace u - (lambda + G) grad div u.
  Eigen::Vector2d body_force(const Eigen::Vector2d& p) const {
    const Eigen::Matrix3d d = elasticity<Triangle6>(material);
    const double shear = d(2, 2), sum = d(0, 1) + shear, divergence = a + c * b;
    const Eigen::Vector2d u = displacement(p);
    return shear * (a * a + b * b) * u + sum * divergence * Eigen::Vector2d(a * u.x(), b * u.y() / c);
  }
};

struct Errors {
  double displacement = 0, energy = 0;
};

Errors errors_on(int cells) {
  const Manufactured problem;
  const Grid grid = testing::make_grid(cells, 2 * cells, testing::annular_sector(0.5, 1.0, 6));
  const std::vector<Material> materials{problem.material};
  const FullMatrices full = Assembler(grid.mesh).stiffness_and_mass(grid.mesh, materials);
  Eigen::VectorXd exact(2 * grid.mesh.nodes.cols()), force = Eigen::VectorXd::Zero(exact.size());
  for (Eigen::Index k = 0; k < grid.mesh.nodes.cols(); ++k)
    exact.segment<2>(2 * k) = problem.displacement(grid.mesh.nodes.col(k));
  for (int e = 0; e < grid.mesh.element_count(); ++e) {
    const ElementNodes<Triangle6> nodes = element_nodes<Triangle6>(grid.mesh, e);
    for (const QuadraturePoint<2>& point : Triangle6::quadrature()) {
      const Triangle6::Shape n = Triangle6::shape(point.local);
      const Eigen::Vector2d body = problem.body_force(nodes * n);
      const double area = point.weight * spatial_gradients<Triangle6>(nodes, point.local).determinant;
      for (std::size_t a = 0; a < 6; ++a)
        force.segment<2>(2 * grid.mesh.element(e)[a]) += area * n[static_cast<Eigen::Index>(a)] * body;
    }
  }
  const Eigen::VectorXd u = testing::solve_held(full.stiffness, force, testing::outline_dofs(grid), exact);
  const StressField stress = quadrature_stress(grid.mesh, materials, u);
  const Eigen::Matrix3d compliance = elasticity<Triangle6>(problem.material).inverse();
  Errors errors;
  for (int e = 0; e < grid.mesh.element_count(); ++e) {
    const ElementNodes<Triangle6> nodes = element_nodes<Triangle6>(grid.mesh, e);
    ElementNodes<Triangle6> local;
    for (std::size_t a = 0; a < 6; ++a)
      local.col(static_cast<Eigen::Index>(a)) = u.segment<2>(2 * grid.mesh.element(e)[a]);
    for (int q = 0; q < Triangle6::kPoints; ++q) {
      const QuadraturePoint<2>& point = Triangle6::quadrature()[static_cast<std::size_t>(q)];
      const Triangle6::Shape n = Triangle6::shape(point.local);
      const Eigen::Vector2d place = nodes * n;
      const double area = point.weight * spatial_gradients<Triangle6>(nodes, point.local).determinant;
      const Eigen::Vector3d wrong = stress.col(Triangle6::kPoints * e + q) - problem.stress(place);
      errors.displacement += area * (local * n - problem.displacement(place)).squaredNorm();
      errors.energy += area * wrong.dot(compliance * wrong);
    }
  }
  return {std::sqrt(errors.displacement), std::sqrt(errors.energy)};
}

// Quadratic elements on curved sides: order 3 in displacement (L2), order 2 in the energy norm. The
// slopes between successive meshes approach these; 0.15 covers what is left of the pre-asymptotic range.
TEST(ManufacturedSolution, ConvergesAtOrdersThreeAndTwo) {
  const std::array<Errors, 4> errors{errors_on(4), errors_on(8), errors_on(16), errors_on(32)};
  for (std::size_t k = 1; k < errors.size(); ++k) {
    const double displacement = std::log2(errors[k - 1].displacement / errors[k].displacement);
    const double energy = std::log2(errors[k - 1].energy / errors[k].energy);
    RecordProperty("displacement_slope_" + std::to_string(k), std::to_string(displacement));
    RecordProperty("energy_slope_" + std::to_string(k), std::to_string(energy));
    EXPECT_GT(displacement, 2.85) << k;
    EXPECT_GT(energy, 1.85) << k;
  }
}

}  // namespace
}  // namespace dovetail::fem
