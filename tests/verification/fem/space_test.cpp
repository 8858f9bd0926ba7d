#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <numbers>

#include "fem/assembly.hpp"
#include "fem/element.hpp"
#include "fem/sector_system.hpp"
#include "fem/stress.hpp"
#include "numerics/sparse_modes.hpp"
#include "tests/unit/fem/extruded_mesh.hpp"
#include "tests/unit/fem/structured_mesh.hpp"

namespace dovetail::fem {
namespace {

/// u_i = sin(k_i . x): as smooth as its waves are long, and no symmetry helps.
struct Waves {
  Material material{.youngs_modulus = 1, .poisson_ratio = 0.3, .density = 1};
  Eigen::Matrix3d waves = (Eigen::Matrix3d() << 1.5, 2.0, 1.0, -1.0, 1.8, 0.7, 0.9, -1.2, 2.2).finished();  // rows k_i

  Eigen::Vector3d displacement(const Eigen::Vector3d& x) const { return (waves * x).array().sin(); }
  Eigen::Matrix<double, 6, 1> stress(const Eigen::Vector3d& x) const {
    const Eigen::Matrix3d g = Eigen::Vector3d((waves * x).array().cos()).asDiagonal() * waves;
    Eigen::Matrix<double, 6, 1> strain;
    strain << g(0, 0), g(1, 1), g(2, 2), g(0, 1) + g(1, 0), g(1, 2) + g(2, 1), g(2, 0) + g(0, 2);
    return elasticity<Wedge18>(material) * strain;
  }
  Eigen::Vector3d body_force(const Eigen::Vector3d& x) const {
    const double shear = 1 / 2.6, lame = 0.3 / (1.3 * 0.4);
    const Eigen::Vector3d sine = displacement(x);
    // grad div u = -sum_i k_i[i] k_i sin, laplacian u_i = -|k_i|^2 sin.
    const Eigen::Vector3d grad_div = -(waves.transpose() * waves.diagonal().cwiseProduct(sine));
    const Eigen::Vector3d laplacian = -waves.rowwise().squaredNorm().cwiseProduct(sine);
    return -(lame + shear) * grad_div - shear * laplacian;
  }
};

struct Errors {
  double displacement = 0, energy = 0;
};

/// On a sector of an annulus, twisted along z: every edge is curved.
Errors errors_on(int cells) {
  const Waves problem;
  const double length = 0.5;
  const testing::Grid grid = testing::make_grid(cells, cells, testing::annular_sector(0.5, 1.0, 6));
  const Mesh mesh = testing::extrude(grid.mesh, cells, length, [](const Eigen::Vector2d& p, double z) {
    const Eigen::Vector2d turned = Eigen::Rotation2D<double>(0.5 * z) * p;
    return Eigen::Vector3d(turned.x(), turned.y(), z + 0.1 * z * p.x());
  });
  const std::vector<Material> materials{problem.material};
  const FullMatrices full = Assembler(mesh).stiffness_and_mass(mesh, materials);
  const int n = grid.mesh.node_count(), levels = 2 * cells + 1;
  std::vector<int> held;
  for (int l = 0; l < levels; ++l)
    for (int j = 0; j < levels; ++j)
      for (int i = 0; i < levels; ++i)
        if (std::min({i, j, l}) == 0 || std::max({i, j, l}) == levels - 1)
          for (int c = 0; c < 3; ++c) held.push_back(3 * (grid.node(i, j) + n * l) + c);
  Eigen::VectorXd exact(3 * mesh.nodes.cols()), force = Eigen::VectorXd::Zero(exact.size());
  for (Eigen::Index k = 0; k < mesh.nodes.cols(); ++k)
    exact.segment<3>(3 * k) = problem.displacement(mesh.nodes.col(k));
  for (int e = 0; e < mesh.element_count(); ++e) {
    const ElementNodes<Wedge18> nodes = element_nodes<Wedge18>(mesh, e);
    for (const QuadraturePoint<3>& point : Wedge18::quadrature()) {
      const Wedge18::Shape shape = Wedge18::shape(point.local);
      const Eigen::Vector3d body = problem.body_force(nodes * shape);
      const double volume = point.weight * spatial_gradients<Wedge18>(nodes, point.local).determinant;
      for (int a = 0; a < Wedge18::kNodes; ++a)
        force.segment<3>(3 * mesh.element(e)[static_cast<std::size_t>(a)]) += volume * shape[a] * body;
    }
  }
  const Eigen::VectorXd u = testing::solve_held(full.stiffness, force, held, exact);
  const StressField stress = quadrature_stress(mesh, materials, u);
  const Elasticity<Wedge18> compliance = elasticity<Wedge18>(problem.material).inverse();
  Errors errors;
  for (int e = 0; e < mesh.element_count(); ++e) {
    const ElementNodes<Wedge18> nodes = element_nodes<Wedge18>(mesh, e);
    ElementNodes<Wedge18> local;
    for (int a = 0; a < Wedge18::kNodes; ++a)
      local.col(a) = u.segment<3>(3 * mesh.element(e)[static_cast<std::size_t>(a)]);
    for (int q = 0; q < Wedge18::kPoints; ++q) {
      const QuadraturePoint<3>& point = Wedge18::quadrature()[static_cast<std::size_t>(q)];
      const Wedge18::Shape shape = Wedge18::shape(point.local);
      const Eigen::Vector3d place = nodes * shape;
      const double volume = point.weight * spatial_gradients<Wedge18>(nodes, point.local).determinant;
      const Eigen::Matrix<double, 6, 1> wrong = stress.col(Wedge18::kPoints * e + q) - problem.stress(place);
      errors.displacement += volume * (local * shape - problem.displacement(place)).squaredNorm();
      errors.energy += volume * wrong.dot(compliance * wrong);
    }
  }
  return {std::sqrt(errors.displacement), std::sqrt(errors.energy)};
}

// Order 3 in displacement (L2), order 2 in the energy norm, as in the plane. What 0.2 covers is left of the
// pre-asymptotic range on such coarse meshes.
TEST(ManufacturedSolutionInSpace, ConvergesAtOrdersThreeAndTwo) {
  const std::array<int, 3> cells{2, 4, 6};
  std::array<Errors, 3> errors;
  for (std::size_t k = 0; k < cells.size(); ++k) errors[k] = errors_on(cells[k]);
  for (std::size_t k = 1; k < cells.size(); ++k) {
    const double refinement = std::log(static_cast<double>(cells[k]) / cells[k - 1]);
    const double displacement = std::log(errors[k - 1].displacement / errors[k].displacement) / refinement;
    const double energy = std::log(errors[k - 1].energy / errors[k].energy) / refinement;
    RecordProperty("displacement_slope_" + std::to_string(k), std::to_string(displacement));
    RecordProperty("energy_slope_" + std::to_string(k), std::to_string(energy));
    EXPECT_GT(displacement, 2.8) << k;
    EXPECT_GT(energy, 1.8) << k;
  }
}

/// A square beam along y from the axis of rotation, clamped at y = 0; length 1.
struct SquareBeam {
  double side;
  std::vector<Material> materials;
  Mesh mesh;
  FullMatrices full;
  Eigen::SparseMatrix<double> selection;

  SquareBeam(double h, const Material& material, int along)
      : side(h),
        materials{material},
        mesh(testing::extrude(testing::make_grid(1, along, testing::rectangle(h, 1, -h / 2, 0)).mesh, 1, h)),
        full(Assembler(mesh).stiffness_and_mass(mesh, materials)) {
    std::vector<int> held;
    for (int k = 0; k < mesh.node_count(); ++k)
      if (mesh.nodes(1, k) == 0)
        for (int c = 0; c < 3; ++c) held.push_back(3 * k + c);
    selection = testing::free_selection(full.stiffness.rows(), held);
  }
  Eigen::SparseMatrix<double> free(const Eigen::SparseMatrix<double>& matrix) const {
    return testing::restrict_to(matrix, selection);
  }
  /// sqrt(E I / (rho A L^4))
  double unit_frequency() const { return side * std::sqrt(materials[0].youngs_modulus / (12 * materials[0].density)); }
};

// Uniform rotating cantilever, no hub: flapping frequencies omega / sqrt(E I / rho A L^4) at speeds Omega in the same
// unit [Wright, Smith, Thresher & Wang, J. Appl. Mech. 49 (1982) 197]; out of the plane of rotation (z) the beam flaps,
// in it (x) omega_lag^2 = omega_flap^2 - Omega^2: spin softening acts there only.
TEST(RotatingBeamInSpace, FlapsAndLagsLikePublishedFrequencies) {
  const Material material{.youngs_modulus = 1e11, .poisson_ratio = 0, .density = 5000};
  const SquareBeam beam(1.0 / 100, material, 40);
  const double unit = beam.unit_frequency();
  struct Published {
    double speed;
    std::array<double, 2> flap;
  };
  for (const Published& row :
       {Published{0, {3.5160, 22.0345}}, Published{4, {5.5850, 24.2733}}, Published{10, {11.2023, 33.6404}}}) {
    const double omega = row.speed * unit;
    numerics::SparseCholesky<double> cholesky;
    ASSERT_EQ(cholesky.factorise(beam.free(beam.full.stiffness)), Status::converged);
    const Eigen::VectorXd load = centrifugal_load(beam.full.mass, beam.mesh) * (omega * omega);
    const Eigen::VectorXd u = beam.selection * cholesky.solve(Eigen::VectorXd(beam.selection.transpose() * load));
    const Eigen::SparseMatrix<double> geometric =
        Assembler(beam.mesh).geometric_stiffness(beam.mesh, quadrature_stress(beam.mesh, beam.materials, u));
    const Eigen::SparseMatrix<double> k = beam.free(stiffness_at_speed(beam.full, geometric, omega));
    const numerics::Modes<double> modes = numerics::smallest_modes<double>(k, beam.free(beam.full.mass), {.count = 4});
    ASSERT_EQ(modes.status, Status::converged);
    for (int pair = 0; pair < 2; ++pair) {
      const double flap = row.flap[static_cast<std::size_t>(pair)];
      // Ascending: lag is the lower one of each pair. Shear, rotary inertia and the digits published: see the plane.
      const double allowed = pair == 0 ? 3e-4 : 1.3e-3;
      EXPECT_NEAR(std::sqrt(modes.eigenvalues[2 * pair]) / unit, std::sqrt(flap * flap - row.speed * row.speed),
                  allowed * flap)
          << row.speed << " lag " << pair;
      EXPECT_NEAR(std::sqrt(modes.eigenvalues[2 * pair + 1]) / unit, flap, allowed * flap)
          << row.speed << " flap " << pair;
      // Which is which: the share of the motion along z.
      const Eigen::MatrixXd shape =
          (beam.selection * modes.vectors.col(2 * pair + 1)).reshaped(3, beam.mesh.nodes.cols());
      if (row.speed > 0) {
        EXPECT_GT(shape.row(2).norm(), 0.99 * shape.norm());
      }
    }
  }
}

}  // namespace
}  // namespace dovetail::fem
