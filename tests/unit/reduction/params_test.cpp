#include "reduction/params.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "reduction/massless_boundary.hpp"

namespace dovetail::reduction {
namespace {

TEST(Params, TellRigidFromSoftModesAtTheUsualTolerance) {
  // In a Krylov space modes converge the earlier the softer they are.
  EXPECT_LE(ReductionOptions{}.eigen_tolerance * FloatingParams{}.soft, 2e-7)
      << "soft modes, which a reduction takes for exact, nearly are";
  EXPECT_GE(FloatingParams{}.search_always, ReductionOptions{}.modes) << "a search goes beyond the modes kept";
}

TEST(Params, BoundMatricesThatIndicesReach) {
  EXPECT_LE(ModelFileParams{}.largest, std::numeric_limits<int>::max());
}

}  // namespace
}  // namespace dovetail::reduction
