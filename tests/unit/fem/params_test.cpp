#include "fem/params.hpp"

#include <gtest/gtest.h>

#include "fem/diameter_frequencies.hpp"

namespace dovetail::fem {
namespace {

TEST(Params, TakeResidualsOfModesForNoDirection) {
  EXPECT_GT(DiameterBasisParams{}.fresh, DiameterOptions{}.modes.tolerance);
}

}  // namespace
}  // namespace dovetail::fem
