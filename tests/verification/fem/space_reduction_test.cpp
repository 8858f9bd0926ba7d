#include <gtest/gtest.h>

#include <array>

#include "fem/glued_modes.hpp"
#include "reduction/massless_boundary.hpp"
#include "tests/unit/fem/extruded_mesh.hpp"
#include "tests/unit/fem/internal_block.hpp"
#include "tests/unit/fem/structured_mesh.hpp"
#include "tests/unit/reduction/stiffness_error.hpp"
#include "tests/verification/fem/sector_model.hpp"

namespace dovetail::fem {
namespace {

// A joint in space with two tangential directions, its blade held by contact alone: spin softening gives it negative
// modes, and along the axis it floats.
TEST(JointInSpace, IsReducedLikeOneInThePlane) {
  SectorMesh sector = testing::extrude(testing::toothed_sector(2, 2, 2, 9, false), 2, 0.03, 3);
  for (int node : sector.bore_nodes)
    if (std::abs(sector.mesh.nodes(2, node) - 0.015) < 1e-9) sector.axial_nodes.push_back(node);
  const std::vector<Material> materials(2);
  const SectorSystem system = build_sector_system(sector, materials, Assembler(sector.mesh));
  const reduction::FullModel full = testing::sector_model(system, 1000, 0.3);
  ASSERT_EQ(full.contact.directions(), 3);
  const reduction::Reduction reduced = reduction::reduce(full, {.modes = 30});
  ASSERT_EQ(reduced.status, Status::converged) << reduced.message;
  ASSERT_EQ(reduced.model.contact.directions(), 3);
  EXPECT_GT(reduced.rigid_modes + reduced.negative_modes, 0);

  numerics::SparseCholesky<double> cholesky;
  const numerics::Modes<double> glued =
      numerics::smallest_modes<double>(internal_block(full.stiffness, system.constraints),
                                       internal_block(full.mass, system.constraints), {.count = 2}, cholesky);
  ASSERT_EQ(glued.status, Status::converged);
  for (Eigen::Index k = 0; k < 2; ++k)
    EXPECT_NEAR(reduced.glued_frequencies[k] / std::sqrt(glued.eigenvalues[k]), 1, 1e-3) << k;

  // Statically exact; at frequencies below the first glued one the error is a share of the neglected inertia.
  const double first = std::sqrt(glued.eigenvalues[0]);
  const std::array<double, 2> frequencies{0.01 * first, 0.7 * first};
  const std::vector<reduction::StiffnessError> errors = reduction::compare(full, reduced, frequencies);
  EXPECT_LT(errors[0].flexibility, 1e-7);
  EXPECT_LT(errors[1].flexibility, 1e-2);
  RecordProperty("flexibility_error", std::to_string(errors[1].flexibility));
}

}  // namespace
}  // namespace dovetail::fem
