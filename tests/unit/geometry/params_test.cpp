#include "geometry/mesh/params.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "geometry/mesh/flank_fractions.hpp"
#include "geometry/mesh/mesh_quality.hpp"
#include "geometry/profile/parameters.hpp"
#include "geometry/profile/params.hpp"
#include "geometry/rules/params.hpp"

namespace dovetail::geometry {
namespace {

TEST(Params, ResolveTheSmallestCoreOfAnyGrading) {
  const auto table = option_table<MeshSizes>();
  const auto grading = std::ranges::find(table, "flank_grading", &Field<MeshSizes>::key);
  ASSERT_NE(grading, table.end());
  const double core = 0.5 / (grading->range.upper - 1), sample = 0.5 / FractionParams{}.samples;
  EXPECT_GT(core, 100 * sample);
}

TEST(Params, AllowRoundedFlanksTheEdgesOfSharpOnes) {
  const MeshSizes sizes{.flank_elements = 128};
  const std::vector<double> ends = flank_fractions({}, sizes);
  double longest = 0;
  for (std::size_t k = 1; k < ends.size(); ++k) longest = std::max(longest, ends[k] - ends[k - 1]);
  EXPECT_NEAR(longest * sizes.flank_elements, FractionParams{}.longest, 0.1);
}

TEST(Params, FillBetterThanMovedMeshesMustBe) {
  EXPECT_GT(FillingParams{}.good, MeshLimits{}.minimum_scaled_jacobian);
}

TEST(Params, KeepRulesBelowTheLimitsOfAStudy) {
  EXPECT_LT(RuleParams{}.straight, FeasibilityLimits{}.minimum_wall);
  EXPECT_LT(EdgeParams{}.drop, RuleParams{}.straight) << "roundings stay within the micrometre form";
}

}  // namespace
}  // namespace dovetail::geometry
