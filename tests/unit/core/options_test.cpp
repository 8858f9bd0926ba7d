#include "core/options.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace {

enum class Shape { round, flat };
constexpr dovetail::EnumNames<Shape, 2> enum_names(Shape) {
  return {{{Shape::round, "round"}, {Shape::flat, "flat_ended"}}};
}
static_assert(dovetail::name_of(Shape::flat) == "flat_ended");
static_assert(dovetail::named<Shape>("round") == Shape::round);
static_assert(!dovetail::named<Shape>("flat"));

struct Sample {
  double length = 0.002;
  int count = 3;
  std::string law = "soft";
  Shape shape = Shape::round;
  std::optional<Shape> other = {};
};

}  // namespace

template <>
std::span<const dovetail::Field<Sample>> dovetail::option_table<Sample>() {
  static const std::array<Field<Sample>, 5> table{
      Field<Sample>{.key = "length_mm", .member = &Sample::length, .si_per_unit = 1e-3, .range = kPositive},
      Field<Sample>{.key = "count", .member = &Sample::count, .range = {.lower = 1, .upper = 9}},
      Field<Sample>{.key = "law", .member = &Sample::law, .choices = {"soft", "hard"}},
      Field<Sample>{.key = "shape", .member = &Sample::shape}, Field<Sample>{.key = "other", .member = &Sample::other}};
  return table;
}

namespace dovetail {
namespace {

TEST(Options, DefaultsAreValid) {
  EXPECT_TRUE(violations(Sample{}).empty());
}

TEST(Options, EveryViolationIsReportedAtOnceInFileUnits) {
  const std::vector<Violation> found = violations(Sample{.length = -0.002, .count = 0, .law = "wrong"}, "sample");
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[0].sentence(), "sample.length_mm = -2: must be > 0");
  EXPECT_EQ(found[1].sentence(), "sample.count = 0: must be >= 1 and <= 9");
  EXPECT_EQ(found[2].sentence(), "sample.law = wrong: must be one of soft, hard");
}

TEST(Options, AnEnumerationIsReadAndWrittenByItsNames) {
  const Field<Sample>& shape = option_table<Sample>()[3];
  Sample sample;
  EXPECT_TRUE(is_text(shape));
  EXPECT_EQ(choices_of(shape), (std::vector<std::string_view>{"round", "flat_ended"}));
  EXPECT_EQ(text_in(sample, shape), "round");
  set_text(sample, shape, "flat_ended");
  EXPECT_EQ(sample.shape, Shape::flat);
  EXPECT_TRUE(std::isnan(value_in_file_unit(sample, shape)));
}

TEST(Options, AnOptionalEnumerationMayBeLeftOpen) {
  const Field<Sample>& other = option_table<Sample>()[4];
  Sample sample;
  EXPECT_EQ(text_in(sample, other), "");
  EXPECT_TRUE(violations(sample).empty());
  set_text(sample, other, "flat_ended");
  EXPECT_EQ(sample.other, Shape::flat);
  EXPECT_EQ(text_in(sample, other), "flat_ended");
}

TEST(Options, ANumberThatIsNoValueOfTheEnumerationIsRefused) {
  const std::vector<Violation> found = violations(Sample{.shape = static_cast<Shape>(7)}, "sample");
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].sentence(), "sample.shape = unknown: must be one of round, flat_ended");
}

TEST(Options, NotANumberIsNeverInRange) {
  EXPECT_FALSE(kAnyNumber.contains(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_FALSE(kAnyNumber.contains(kInfinity));
  EXPECT_EQ(violations(Sample{.length = std::numeric_limits<double>::quiet_NaN()}).size(), 1U);
}

TEST(Options, AClosedEndMayBeLeftByTheRoundingOfTheUnits) {
  const Range range{.lower = 0.3, .upper = 500};
  EXPECT_FALSE(range.contains(500.00000000000006));
  EXPECT_TRUE(range.contains_rounded(500.00000000000006));
  EXPECT_TRUE(range.contains_rounded(0.29999999999999993));
  EXPECT_FALSE(range.contains_rounded(500.0000000001));
  EXPECT_FALSE(range.contains_rounded(0.2999999999));
  EXPECT_FALSE(range.contains_rounded(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_FALSE(range.contains_rounded(kInfinity));
  EXPECT_TRUE(kAnyNumber.contains_rounded(1e300));
  EXPECT_FALSE(kAnyNumber.contains_rounded(kInfinity));
}

TEST(Options, AnOpenEndIsNeverInside) {
  const Range range{.lower = 0, .upper = 0.5, .lower_open = true, .upper_open = true};
  EXPECT_FALSE(range.contains_rounded(0));
  EXPECT_FALSE(range.contains_rounded(0.5));
  EXPECT_FALSE(kNonNegative.contains_rounded(-1e-300));
}

TEST(Options, NearestFindsTheMisspeltKey) {
  const std::vector<std::string> keys{"neck_width_mm", "neck_height_mm", "slot_length_mm"};
  EXPECT_EQ(nearest("nek_width_mm", keys), "neck_width_mm");
  EXPECT_EQ(nearest("zzz", keys), "");
}

TEST(Options, ShortestTextReadsBackExactly) {
  for (const double value : {0.1, 1.0 / 3.0, 1e-300, -2.5e17}) EXPECT_EQ(std::stod(shortest(value)), value);
  const double nan = std::nan("");
  for (const double none : {nan, std::copysign(nan, -1)}) EXPECT_EQ(shortest(none), "nan");
}

}  // namespace
}  // namespace dovetail
