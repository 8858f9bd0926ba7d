#include "optimizer/search/space_filling.hpp"

#include <gtest/gtest.h>

#include <set>

#include "optimizer/search/random_stream.hpp"

namespace dovetail::optimizer {
namespace {

TEST(LatinHypercube, PutsOnePointInEverySlice) {
  const auto points = latin_hypercube(17, 3, 5);
  ASSERT_EQ(points.size(), 17U);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::set<int> slices;
    for (const auto& point : points) slices.insert(static_cast<int>(point[axis] * 17));
    EXPECT_EQ(slices.size(), 17U);
  }
}

TEST(LatinHypercube, DependsOnTheSeedOnly) {
  EXPECT_EQ(latin_hypercube(9, 4, 1), latin_hypercube(9, 4, 1));
  EXPECT_NE(latin_hypercube(9, 4, 1), latin_hypercube(9, 4, 2));
  EXPECT_TRUE(latin_hypercube(0, 4, 1).empty());
  EXPECT_EQ(latin_hypercube(1, 2, 1).size(), 1U);
}

TEST(RandomStream, IsTheSameOnEveryPlatform) {
  // First outputs of splitmix64 for the seed 1234567 as published with the generator.
  RandomStream random(1234567);
  EXPECT_EQ(random.bits(), 6457827717110365317ULL);
  EXPECT_EQ(random.bits(), 3203168211198807973ULL);
  EXPECT_EQ(random.bits(), 9817491932198370423ULL);
}

TEST(RandomStream, StaysInItsRange) {
  RandomStream random(3);
  std::set<std::uint64_t> seen;
  for (int i = 0; i < 1000; ++i) {
    const double u = random.uniform();
    EXPECT_GE(u, 0);
    EXPECT_LT(u, 1);
    seen.insert(random.below(7));
  }
  EXPECT_EQ(*seen.rbegin(), 6U);
  EXPECT_EQ(seen.size(), 7U);
}

}  // namespace
}  // namespace dovetail::optimizer
