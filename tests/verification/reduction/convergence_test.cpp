#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "numerics/dense_symmetric.hpp"
#include "reduction/massless_boundary.hpp"
#include "tests/unit/reduction/stiffness_error.hpp"
#include "tests/unit/reduction/truss_model.hpp"

namespace dovetail::reduction {
namespace {

// 1200 dofs: large enough for the Lanczos route.
const TrussSettings kLarge{.columns = 12, .blade_rows = 40, .disk_rows = 10, .speed = 1.0};

TEST(MasslessBoundaryConvergence, ErrorGrowsWithTheSquareOfTheFrequency) {
  const FullModel full = truss_model(kLarge);
  const Reduction reduction = reduce(full, {.modes = 12});
  ASSERT_EQ(reduction.status, Status::converged) << reduction.message;
  const double first = reduction.glued_frequencies(0);
  const std::vector<StiffnessError> errors =
      compare(full, reduction, std::vector{0.05 * first, 0.1 * first, 0.2 * first});
  for (std::size_t k = 0; k + 1 < errors.size(); ++k) {
    const double slope = std::log2(errors[k + 1].stiffness / errors[k].stiffness);
    // The next term is of relative size (w/w_1)^2 <= 0.04, which moves the slope by 0.06.
    EXPECT_NEAR(slope, 2.0, 0.1);
  }
}

// Z^-1 improves at least as fast as the first term of the residual series, w^2/w_cut^2. In norm Z is that of stiff
// local motions, whose inertia w^2 m a massless boundary drops until modes of that scale are kept: it only falls.
TEST(MasslessBoundaryConvergence, InverseImprovesWithTheCutOff) {
  const FullModel full = truss_model(kLarge);
  double last_stiffness = 1, last_flexibility = 1, last_cut = 0;
  for (int modes : {10, 20, 40, 80}) {
    const Reduction reduction = reduce(full, {.modes = modes});
    ASSERT_EQ(reduction.status, Status::converged) << reduction.message;
    const double angular = 1.5 * reduction.glued_frequencies(0);
    const StiffnessError error = compare(full, reduction, std::vector{angular}).front();
    const double cut = reduction.first_neglected_eigenvalue;
    if (last_cut > 0) {
      EXPECT_LT(error.flexibility, 1.1 * last_flexibility * last_cut / cut) << modes;
      EXPECT_LT(error.stiffness, last_stiffness) << modes;
    }
    last_stiffness = error.stiffness;
    last_flexibility = error.flexibility;
    last_cut = cut;
  }
  EXPECT_LT(last_stiffness, 1e-4);
  EXPECT_LT(last_flexibility, 1e-5);
}

TEST(MasslessBoundaryConvergence, LanczosModesAreEigenpairsAtStandstillAndAtSpeed) {
  for (double speed : {0.0, 1.0}) {
    // 480 dofs: beyond the dense route, yet quick to compare with a dense eigen-decomposition.
    const TrussSettings settings{.columns = 8, .blade_rows = 24, .disk_rows = 6, .speed = speed};
    const FullModel full = truss_model(settings);
    const Reduction reduction = reduce(full, {.modes = 25});
    ASSERT_EQ(reduction.status, Status::converged) << reduction.message;
    EXPECT_EQ(reduction.rigid_modes, speed > 0 ? 0 : 3);
    const Eigen::VectorXd exact = numerics::all_values<double>(full.stiffness, full.mass).values;
    const double scale = exact(24);
    for (int k = 0; k < 25; ++k) EXPECT_NEAR(reduction.free_eigenvalues(k), exact(k), 1e-9 * scale) << k;
    EXPECT_NEAR(reduction.first_neglected_eigenvalue, exact(25), 1e-6 * scale);
  }
}

}  // namespace
}  // namespace dovetail::reduction
