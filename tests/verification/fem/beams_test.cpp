#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "fem/assembly.hpp"
#include "fem/sector_system.hpp"
#include "fem/stress.hpp"
#include "numerics/dense_symmetric.hpp"
#include "numerics/sparse_modes.hpp"
#include "tests/unit/fem/structured_mesh.hpp"

namespace dovetail::fem {
namespace {

/// A column along y from the axis of rotation, clamped at y = 0; length 1, square cells, unit thickness.
struct Cantilever {
  double height;
  std::vector<Material> materials;
  testing::Grid grid;
  FullMatrices full;
  Eigen::SparseMatrix<double> selection;

  Cantilever(double h, const Material& material, int along)
      : height(h),
        materials{material},
        grid(testing::make_grid(2, along, testing::rectangle(h, 1, -h / 2, 0))),
        full(Assembler(grid.mesh).stiffness_and_mass(grid.mesh, materials)) {
    std::vector<int> held;
    // Held axially everywhere but sideways in the middle only: Poisson's contraction stays free, as in beam theory.
    for (int i = 0; i <= 4; ++i) held.push_back(2 * grid.node(i, 0) + 1);
    held.push_back(2 * grid.node(2, 0));
    selection = testing::free_selection(full.stiffness.rows(), held);
  }
  Eigen::SparseMatrix<double> free(const Eigen::SparseMatrix<double>& matrix) const {
    return testing::restrict_to(matrix, selection);
  }
  double plane_modulus() const {
    return materials[0].youngs_modulus / (1 - materials[0].poisson_ratio * materials[0].poisson_ratio);
  }
  double inertia() const { return height * height * height / 12; }
  /// sqrt(E' I / (rho A L^4))
  double unit_frequency() const { return std::sqrt(plane_modulus() * inertia() / (materials[0].density * height)); }
};

/// Clamped-free Euler-Bernoulli mode for the root beta of cos cosh = -1, and the first-order loss
/// of frequency to rotary inertia and shear: 1/omega^2 = 1/omega_EB^2 (1 + rotary + shear),
/// rotary = I/A int(w'^2)/int(w^2), shear = E'I/(kappa G A) int(w'''^2)/int(w''^2) [Timoshenko 1921].
double timoshenko_loss(double beta, double inertia_over_area, double modulus_over_shear) {
  const double s = (std::cosh(beta) + std::cos(beta)) / (std::sinh(beta) + std::sin(beta));
  std::array<double, 4> integrals{};
  const int points = 4000;
  for (int k = 0; k < points; ++k) {
    const double x = beta * (k + 0.5) / points;
    const double ch = std::cosh(x), sh = std::sinh(x), c = std::cos(x), si = std::sin(x);
    const std::array<double, 4> derivatives{ch - c - s * (sh - si), sh + si - s * (ch - c), ch + c - s * (sh + si),
                                            sh - si - s * (ch + c)};
    for (std::size_t d = 0; d < 4; ++d) integrals[d] += derivatives[d] * derivatives[d];
  }
  return inertia_over_area * beta * beta *
         (integrals[1] / integrals[0] + modulus_over_shear * integrals[3] / integrals[2]);
}

TEST(Cantilever, FrequenciesFollowBeamTheoryWithTimoshenkosCorrection) {
  const Material titanium;
  const Cantilever beam(1.0 / 40, titanium, 80);
  const numerics::Modes<double> modes =
      numerics::smallest_modes<double>(beam.free(beam.full.stiffness), beam.free(beam.full.mass), {.count = 3});
  ASSERT_EQ(modes.status, Status::converged);
  // Shear coefficient of a rectangle 5 (1 + nu')/(6 + 5 nu') with the plane strain nu' = nu/(1 - nu) [Cowper 1966].
  const double nu = titanium.poisson_ratio / (1 - titanium.poisson_ratio), kappa = 5 * (1 + nu) / (6 + 5 * nu);
  const double shear_modulus = titanium.youngs_modulus / (2 * (1 + titanium.poisson_ratio));
  const std::array<double, 3> roots{1.8751040687119611, 4.694091132974175, 7.854757438237613};
  for (std::size_t k = 0; k < 3; ++k) {
    const double loss =
        timoshenko_loss(roots[k], beam.height * beam.height / 12, beam.plane_modulus() / (kappa * shear_modulus));
    const double euler = roots[k] * roots[k] * beam.unit_frequency();
    const double ratio = std::sqrt(modes.eigenvalues[static_cast<Eigen::Index>(k)]) / euler;
    // Left over: second order of the loss; a clamp that stops the section from warping, the shear share
    // times height over length; and the flexibility of the point support, some 1/E against 4 (L/h)^3 / E of the beam.
    EXPECT_NEAR(ratio, 1 / std::sqrt(1 + loss), loss * loss + loss / 40 + 4 * std::pow(beam.height, 3)) << k;
    if (k > 0) {
      EXPECT_GT(std::abs(ratio - 1), 3 * std::abs(ratio - 1 / std::sqrt(1 + loss)));  // the correction matters
    }
  }
}

// Uniform rotating cantilever, no hub: flapping frequencies omega / sqrt(E I / rho A L^4) at speeds Omega in
// the same unit [Wright, Smith, Thresher & Wang, J. Appl. Mech. 49 (1982) 197; Hodges & Rutkowski, AIAA J. 19 (1981)
// 1459]. In the plane of rotation: omega_lag^2 = omega_flap^2 - Omega^2.
TEST(RotatingCantilever, StiffensLikePublishedFrequencies) {
  const Material material{.youngs_modulus = 1e11, .poisson_ratio = 0, .density = 5000};
  const Cantilever beam(1.0 / 100, material, 100);
  const double unit = beam.unit_frequency();
  struct Published {
    double speed;
    std::array<double, 2> flap;
  };
  for (const Published& row : {Published{0, {3.5160, 22.0345}}, Published{1, {3.6816, 22.1810}},
                               Published{4, {5.5850, 24.2733}}, Published{10, {11.2023, 33.6404}}}) {
    const double omega = row.speed * unit;
    const Eigen::SparseMatrix<double> k0 = beam.free(beam.full.stiffness);
    numerics::SparseCholesky<double> cholesky;
    ASSERT_EQ(cholesky.factorise(k0), Status::converged);
    const Eigen::VectorXd load = centrifugal_load(beam.full.mass, beam.grid.mesh) * (omega * omega);
    const Eigen::VectorXd u = beam.selection * cholesky.solve(Eigen::VectorXd(beam.selection.transpose() * load));
    const StressField stress = quadrature_stress(beam.grid.mesh, beam.materials, u);
    const Eigen::SparseMatrix<double> geometric = Assembler(beam.grid.mesh).geometric_stiffness(beam.grid.mesh, stress);
    const Eigen::SparseMatrix<double> k = beam.free(stiffness_at_speed(beam.full, geometric, omega));
    const numerics::Modes<double> modes = numerics::smallest_modes<double>(k, beam.free(beam.full.mass), {.count = 2});
    ASSERT_EQ(modes.status, Status::converged);
    for (std::size_t m = 0; m < 2; ++m) {
      const double lag = std::sqrt(modes.eigenvalues[static_cast<Eigen::Index>(m)]) / unit;
      const double expected = std::sqrt(row.flap[m] * row.flap[m] - row.speed * row.speed);
      // Shear and rotary inertia take up to 1e-3 of the second mode at this slenderness, published digits 2e-5.
      EXPECT_NEAR(lag / expected, 1, m == 0 ? 3e-4 : 1.3e-3) << row.speed << " " << m;
    }
  }
}

TEST(Column, BucklesAtEulersLoad) {
  // A uniform axial stress -1 in a clamped-free column: K v = s (-K_g) v, least s A = pi^2 E I / (4 L^2).
  const Material material{.youngs_modulus = 1e11, .poisson_ratio = 0, .density = 5000};
  const Cantilever beam(1.0 / 40, material, 20);
  StressField stress = StressField::Zero(3, 6 * beam.grid.mesh.element_count());
  stress.row(1).setConstant(-1);
  const Eigen::MatrixXd destiffening =
      -Eigen::MatrixXd(beam.free(Assembler(beam.grid.mesh).geometric_stiffness(beam.grid.mesh, stress)));
  const Eigen::MatrixXd stiffness = beam.free(beam.full.stiffness);
  const double largest = numerics::all_values<double>(destiffening, stiffness).values.tail(1)[0];
  const double euler = std::pow(std::numbers::pi, 2) * beam.plane_modulus() * beam.inertia() / 4;
  // Engesser's shear correction P / (1 + P / (5/6 G A)); G = E/2. The theories of shear in columns differ by a
  // part of that correction, which is 3.1e-4 here.
  const double corrected = euler / (1 + euler / (5.0 / 6 * material.youngs_modulus / 2 * beam.height));
  EXPECT_NEAR(beam.height / largest / corrected, 1, 2e-4);
}

TEST(TautStrip, VibratesLikeAString) {
  // With a tension far above its bending stiffness a strip held at both ends has omega = k pi sqrt(sigma/rho).
  const Material material{.youngs_modulus = 1e3, .poisson_ratio = 0, .density = 1};
  const testing::Grid grid = testing::make_grid(40, 1, testing::rectangle(1, 0.01));
  const std::vector<Material> materials{material};
  const Assembler assembler(grid.mesh);
  FullMatrices full = assembler.stiffness_and_mass(grid.mesh, materials);
  StressField stress = StressField::Zero(3, 6 * grid.mesh.element_count());
  const double tension = 1e2;
  stress.row(0).setConstant(tension);
  full.stiffness += assembler.geometric_stiffness(grid.mesh, stress);
  std::vector<int> held;
  for (int k = 0; k < grid.mesh.node_count(); ++k) {
    held.push_back(2 * k);  // transverse motion only
    const double x = grid.mesh.nodes(0, k);
    if (x == 0 || x == 1) held.push_back(2 * k + 1);
  }
  // Without axial motion the strip shears: G A adds to the tension.
  const double speed = std::sqrt(tension + material.youngs_modulus / 2);
  const Eigen::SparseMatrix<double> selection = testing::free_selection(full.stiffness.rows(), held);
  const numerics::Modes<double> modes = numerics::smallest_modes<double>(
      testing::restrict_to(full.stiffness, selection), testing::restrict_to(full.mass, selection), {.count = 3});
  ASSERT_EQ(modes.status, Status::converged);
  // Dispersion of quadratic elements at the wave number k pi, cells of 1/40: (k pi h)^4 / 720.
  for (int k = 1; k <= 3; ++k)
    EXPECT_NEAR(std::sqrt(modes.eigenvalues[k - 1]) / (k * std::numbers::pi * speed), 1,
                std::pow(k * std::numbers::pi / 40, 4) / 720 + 1e-10)
        << k;
}

}  // namespace
}  // namespace dovetail::fem
