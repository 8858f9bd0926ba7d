#include "optimizer/search/cache.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace dovetail::optimizer {
namespace {

TEST(ExactCache, FindsTheSameBitsOnly) {
  ExactCache cache;
  const std::vector<double> x{0.1, 3};
  cache.insert(x, 7);
  EXPECT_EQ(cache.find(x), 7U);
  EXPECT_FALSE(cache.find(std::vector<double>{std::nextafter(0.1, 1.0), 3}));
  EXPECT_FALSE(cache.find(std::vector<double>{0.1}));
}

TEST(ExactCache, TakesNegativeZeroAsZero) {
  ExactCache cache;
  cache.insert(std::vector<double>{-0.0}, 1);
  EXPECT_EQ(cache.find(std::vector<double>{0.0}), 1U);
  EXPECT_EQ(cache.find(std::vector<double>{-0.0}), 1U);
}

TEST(ExactCache, KeepsTheFirstEntry) {
  ExactCache cache;
  cache.insert(std::vector<double>{1}, 1);
  cache.insert(std::vector<double>{1}, 2);
  EXPECT_EQ(cache.find(std::vector<double>{1}), 1U);
}

}  // namespace
}  // namespace dovetail::optimizer
