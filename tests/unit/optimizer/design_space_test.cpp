#include "optimizer/problem/design_space.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/errors.hpp"

namespace dovetail::optimizer {
namespace {

TEST(DesignSpace, MapsTheBoundsExactly) {
  const DesignSpace space({{.key = "a", .lower = 0.1, .upper = 0.7, .start = 0.3}});
  EXPECT_EQ(space.from_unit(std::vector{0.0})[0], 0.1);
  EXPECT_EQ(space.from_unit(std::vector{1.0})[0], 0.7);
  EXPECT_EQ(space.from_unit(std::vector{-3.0})[0], 0.1);
  EXPECT_EQ(space.from_unit(std::vector{1.0000001})[0], 0.7);
  EXPECT_EQ(space.start(), std::vector{0.3});
}

TEST(DesignSpace, NeverLeavesTheBoxByRounding) {
  // 0.1 + u (0.7 - 0.1) exceeds 0.7 for some u below 1 unless clamped.
  const DesignSpace space({{.key = "a", .lower = 0.1, .upper = 0.7, .start = 0.3}});
  for (double u = 1.0, i = 0; i < 50; u = std::nextafter(u, 0.0), ++i) {
    EXPECT_LE(space.from_unit(std::vector{u})[0], 0.7);
    EXPECT_GE(space.from_unit(std::vector{1 - u})[0], 0.1);
  }
}

TEST(DesignSpace, ComesBackFromUnitCoordinates) {
  const DesignSpace space({{.key = "a", .lower = -5, .upper = 25, .start = 0}});
  // Two roundings of numbers below 30.
  EXPECT_NEAR(space.from_unit(space.to_unit(std::vector{17.3}))[0], 17.3, 30 * 0x1p-52);
}

TEST(DesignSpace, GivesOneZero) {
  const DesignSpace space({{.key = "a", .lower = -0.0, .upper = 1, .start = -0.0}});
  EXPECT_FALSE(std::signbit(space.from_unit(std::vector{0.0})[0]));
  EXPECT_FALSE(std::signbit(space.start()[0]));
}

TEST(DesignSpace, NamesEveryWrongVariable) {
  try {
    DesignSpace({{.key = "a", .lower = 1, .upper = 1, .start = 1},
                 {.key = "b", .lower = 0, .upper = 1, .start = 2},
                 {.key = "c", .lower = 0, .upper = std::numeric_limits<double>::infinity(), .start = 2},
                 {.key = "b", .lower = 0, .upper = 1, .start = std::nan("")}});
    FAIL();
  } catch (const InputError& error) {
    ASSERT_EQ(error.violations().size(), 5U);
    EXPECT_EQ(error.violations()[0].key, "a.upper");
    EXPECT_EQ(error.violations()[1].key, "b.start");
    EXPECT_EQ(error.violations()[2].key, "c.upper");
    EXPECT_EQ(error.violations()[3].allowed, "must be varied only once");
    EXPECT_EQ(error.violations()[4].key, "b.start");
  }
}

}  // namespace
}  // namespace dovetail::optimizer
