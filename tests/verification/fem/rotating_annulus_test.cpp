#include <gtest/gtest.h>

#include <Eigen/LU>
#include <array>
#include <cmath>

#include "fem/sector_system.hpp"
#include "fem/stress.hpp"
#include "numerics/sparse_factor.hpp"
#include "tests/unit/fem/structured_mesh.hpp"

namespace dovetail::fem {
namespace {

// Rotating annulus in plane strain, free inside and outside. With E' = E/(1-nu^2), nu' = nu/(1-nu):
// u = C1 r + C2/r - (1 - nu'^2) rho Omega^2 r^3 / (8 E'), sigma_r = 0 at both radii gives C1 and C2
// [Timoshenko & Goodier, Theory of Elasticity, art. 32, in plane strain constants].
struct RotatingAnnulus {
  double inner, outer, modulus, nu, load;  // E', nu', rho Omega^2
  double c1 = 0, c2 = 0;

  RotatingAnnulus(double a, double b, const Material& m)
      : inner(a),
        outer(b),
        modulus(m.youngs_modulus / (1 - m.poisson_ratio * m.poisson_ratio)),
        nu(m.poisson_ratio / (1 - m.poisson_ratio)),
        load(m.density) {
    Eigen::Matrix2d matrix;
    Eigen::Vector2d right;
    const std::array<double, 2> radii{a, b};
    for (int k = 0; k < 2; ++k) {
      const double r = radii[static_cast<std::size_t>(k)], plate = modulus / (1 - nu * nu);
      matrix.row(k) << plate * (1 + nu), -plate * (1 - nu) / (r * r);
      right[k] = (3 + nu) * load * r * r / 8;
    }
    const Eigen::Vector2d c = matrix.inverse() * right;
    c1 = c[0];
    c2 = c[1];
  }
  double displacement(double r) const { return c1 * r + c2 / r - (1 - nu * nu) * load * r * r * r / (8 * modulus); }
  double hoop_stress(double r) const {
    return modulus / (1 - nu * nu) * ((1 + nu) * c1 + (1 - nu) * c2 / (r * r)) - (1 + 3 * nu) * load * r * r / 8;
  }
};

TEST(RotatingAnnulus, CyclicSectorFindsTheClosedForm) {
  const std::vector<Material> materials{Material{}};
  const RotatingAnnulus exact(0.1, 0.25, materials[0]);
  double previous_displacement = 0, previous_stress = 0;
  for (int cells : {4, 8, 16}) {
    const testing::Grid grid = testing::make_grid(cells, cells, testing::annular_sector(0.1, 0.25, 8));
    const SectorMesh sector = testing::annulus_sector(grid, 8);
    const SectorSystem system = build_sector_system(sector, materials, Assembler(sector.mesh));
    numerics::SparseCholesky<double> cholesky;
    ASSERT_EQ(cholesky.factorise(system.stiffness), Status::converged);
    const Eigen::VectorXd u = system.constraints.transformation * cholesky.solve(system.centrifugal);
    double worst = 0;
    for (int k = 0; k < sector.mesh.node_count(); ++k) {
      const Eigen::Vector2d r = sector.mesh.nodes.col(k);
      const Eigen::Vector2d expected = exact.displacement(r.norm()) * r.normalized();
      worst = std::max(worst, (u.segment<2>(2 * k) - expected).norm() / exact.displacement(0.1));
    }
    const std::vector<int> bore_middle{grid.node(0, cells)};  // where r is along y: hoop stress is sigma_xx
    const Eigen::VectorXd stress = nodal_stress_operator(sector.mesh, materials, bore_middle) * u;
    const double stress_error = std::abs(stress[0] / exact.hoop_stress(0.1) - 1);
    if (previous_displacement != 0) {
      // Orders 3 and 2 mean factors 8 and 4; nodal values may do better.
      EXPECT_LT(worst, previous_displacement / 6);
      EXPECT_LT(stress_error, previous_stress / 3);
    }
    previous_displacement = worst;
    previous_stress = stress_error;
  }
  EXPECT_LT(previous_displacement, 2e-5);
  EXPECT_LT(previous_stress, 5e-3);
}

}  // namespace
}  // namespace dovetail::fem
