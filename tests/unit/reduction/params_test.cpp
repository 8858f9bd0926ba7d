#include "reduction/params.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "reduction/massless_boundary.hpp"

namespace dovetail::reduction {
namespace {

TEST(Params, TellRigidFromSoftModesAtTheUsualTolerance) {
  const double tolerance = ReductionOptions{}.eigen_tolerance, error = tolerance * tolerance;
  EXPECT_LT(error, FloatingParams{}.rigid) << "eigenvalues err by less than what separates the rigid ones";
  EXPECT_GE(FloatingParams{}.search_always, ReductionOptions{}.modes) << "a search goes beyond the modes kept";
}

TEST(Params, BoundMatricesThatIndicesReach) {
  EXPECT_LE(ModelFileParams{}.largest, std::numeric_limits<int>::max());
}

}  // namespace
}  // namespace dovetail::reduction
