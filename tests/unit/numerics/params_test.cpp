#include "numerics/params.hpp"

#include <gtest/gtest.h>

#include "numerics/nearest_modes.hpp"
#include "numerics/newton.hpp"

namespace dovetail::numerics {
namespace {

TEST(Params, ResolveWhatModesOptionsAsk) {
  const ModesOptions options;
  const ModesParams params;
  EXPECT_GT(options.tolerance, params.independent) << "residuals asked for must be above what counts as rounding";
  EXPECT_GE(params.always, params.vectors * options.count) << "the space can be filled once";
}

TEST(Params, OfNewtonsMethodLetASearchEnd) {
  const NewtonParams params;
  EXPECT_LT(params.shortest_cut, params.longest_cut);
  EXPECT_LT(params.longest_cut, 1);
  EXPECT_LT(params.smallest_step, params.shortest_cut) << "a step is cut once at least";
  EXPECT_LT(params.chord_ratio, 1 - params.decrease) << "a chord step reduces more than a search asks for";
}

}  // namespace
}  // namespace dovetail::numerics
