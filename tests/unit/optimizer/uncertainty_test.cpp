#include "optimizer/problem/uncertainty.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/errors.hpp"

namespace dovetail::optimizer {
namespace {

const Uncertain kFriction{.key = "contact.friction", .first = 0.3, .second = 0.5};
const Uncertain kMismatch{.key = "geometry.flank_mismatch_um",
                          .distribution = Distribution::normal,
                          .first = 0,
                          .second = 2,
                          .of = Uncertain::Of::offset};

/// Mean of a function of the changed numbers.
template <class F>
double mean(const std::vector<LoadCase>& samples, const F& of) {
  double sum = 0, weights = 0;
  for (const LoadCase& sample : samples) {
    sum += sample.weight * of(sample.changes);
    weights += sample.weight;
  }
  return sum / weights;
}

// Three points are exact up to the fifth power.
TEST(Sampled, GaussRulesIntegratePolynomials) {
  const std::vector<LoadCase> samples = sampled({}, {kFriction, kMismatch}, {.rule = Rule::gauss, .points = 3});
  ASSERT_EQ(samples.size(), 9U);
  EXPECT_NEAR(mean(samples, [](const auto& c) { return std::pow((c[0].value - 0.4) / 0.1, 4); }), 1.0 / 5, 1e-12);
  EXPECT_NEAR(mean(samples, [](const auto& c) { return std::pow(c[1].value / 2, 4); }), 3, 1e-12);
  EXPECT_NEAR(mean(samples, [](const auto& c) { return std::pow(c[1].value / 2, 3) * (c[0].value - 0.4); }), 0, 1e-12);
  for (const LoadCase& sample : samples) {
    EXPECT_EQ(sample.changes[0].times, 0);
    EXPECT_EQ(sample.changes[1].times, 1);
    EXPECT_EQ(sample.sample_of, "sample");
  }
}

TEST(Sampled, CornersAreTheEndsAndTheMiddle) {
  const std::vector<LoadCase> cases{{.name = "a", .weight = 3, .changes = {{"contact.friction", 0.6}}},
                                    {.name = "b", .changes = {{"loading.tip_force_n", 4}}}};
  const std::vector<LoadCase> samples = sampled(cases, {kFriction, kMismatch}, {});
  ASSERT_EQ(samples.size(), 10U);
  std::set<double> friction, mismatch;
  double weight = 0;
  for (const LoadCase& sample : samples) {
    if (sample.sample_of != "a") continue;
    weight += sample.weight;
    ASSERT_EQ(sample.changes.size(), 2U) << "what is uncertain takes the place of the case's own number";
    friction.insert(sample.changes[0].value);
    mismatch.insert(sample.changes[1].value);
  }
  EXPECT_NEAR(weight, 3, 1e-12);
  EXPECT_THAT(friction, testing::ElementsAre(0.3, testing::DoubleEq(0.4), 0.5));
  EXPECT_NEAR(*mismatch.begin(), -2 * std::sqrt(3.0), 1e-12);
  EXPECT_EQ(samples.back().changes.size(), 3U);
}

/// Standard deviation of a function of the changed numbers.
template <class F>
double deviation(const std::vector<LoadCase>& samples, const F& of) {
  const double middle = mean(samples, of);
  return std::sqrt(mean(samples, [&](const auto& c) { return std::pow(of(c) - middle, 2); }));
}

// A uniform number has a deviation of its range over sqrt 12.
TEST(Sampled, CornersHaveMeanAndDeviationOfWhatIsLinear) {
  const auto linear = [](const auto& c) { return 7 + 5 * c[0].value + (c.size() > 1 ? 3 * c[1].value : 0); };
  EXPECT_NEAR(deviation(sampled({}, {kFriction}, {}), linear), 5 * 0.2 / std::sqrt(12.0), 1e-12);
  const std::vector<LoadCase> both = sampled({}, {kFriction, kMismatch}, {});
  EXPECT_NEAR(mean(both, linear), 7 + 5 * 0.4, 1e-12);
  EXPECT_NEAR(deviation(both, linear), std::hypot(5 * 0.2 / std::sqrt(12.0), 3 * 2), 1e-12);
  // And the mean up to the third degree.
  EXPECT_NEAR(mean(both, [](const auto& c) { return std::pow(c[0].value - 0.4, 2) * 3 + c[1].value * c[1].value; }),
              0.01 + 4, 1e-12);
  EXPECT_NEAR(mean(both, [](const auto& c) { return (c[0].value - 0.4) * c[1].value * c[1].value; }), 0, 1e-12);
}

// Few points as well: in the middle of their cells, and one alone in the middle of all.
TEST(Sampled, SobolPointsHaveTheMeanOfEveryNumber) {
  for (const int points : {1, 2, 16, 64}) {
    const std::vector<LoadCase> samples = sampled({}, {kFriction, kMismatch}, {.rule = Rule::sobol, .points = points});
    EXPECT_NEAR(mean(samples, [](const auto& c) { return c[0].value; }), 0.4, 1e-12) << points;
    EXPECT_NEAR(mean(samples, [](const auto& c) { return c[1].value; }), 0, 1e-9) << points;
    // The square of a cell is what is left of the square of the range.
    const double left = 1 - 1.0 / (points * points);
    EXPECT_NEAR(deviation(samples, [](const auto& c) { return c[0].value; }), 0.2 * std::sqrt(left / 12), 1e-12);
  }
  // The bar of the rule holds what is left where their number is no power of two.
  for (const int points : {3, 5, 12, 20}) {
    const std::vector<LoadCase> samples = sampled({}, {kFriction}, {.rule = Rule::sobol, .points = points});
    std::vector<Barred> numbers;
    for (const LoadCase& sample : samples) numbers.push_back({.value = sample.changes[0].value, .bar = 0});
    const Barred found = over_cases("mean", samples, numbers, 0.5);
    EXPECT_LE(std::abs(found.value - 0.4), found.bar) << points;
    EXPECT_LT(found.bar, 0.2 / 2) << points;
  }
}

TEST(Sampled, SobolPointsFillTheRange) {
  const std::vector<LoadCase> samples = sampled({}, {kFriction, kMismatch}, {.rule = Rule::sobol, .points = 256});
  ASSERT_EQ(samples.size(), 256U);
  EXPECT_NEAR(mean(samples, [](const auto& c) { return c[0].value; }), 0.4, 1e-3);
  EXPECT_NEAR(mean(samples, [](const auto& c) { return c[1].value * c[1].value; }), 4, 0.15);
  for (const LoadCase& sample : samples) {
    EXPECT_GE(sample.changes[0].value, 0.3);
    EXPECT_LE(sample.changes[0].value, 0.5);
  }
}

TEST(Sampled, TooManyAreRefused) {
  const std::vector<Uncertain> many(13, kFriction);
  EXPECT_THROW(static_cast<void>(sampled({}, many, {})), InputError);
}

// What the file says alone, whatever is uncertain.
TEST(Sampled, NominalIsTheFileItself) {
  const std::vector<LoadCase> cases{{.name = "a", .weight = 3, .changes = {{"contact.friction", 0.6}}}};
  const std::vector<LoadCase> samples = sampled(cases, {kFriction, kMismatch}, {.rule = Rule::nominal});
  ASSERT_EQ(samples.size(), 1U);
  EXPECT_EQ(samples[0].sample_of, "a");
  EXPECT_EQ(samples[0].weight, 3);
  ASSERT_EQ(samples[0].changes.size(), 1U);
  EXPECT_EQ(samples[0].changes[0].value, 0.6);
}

// Of a sequence the bar has what its second half changes.
TEST(OverCases, OfASequenceHaveABarOfTheRule) {
  const std::vector<LoadCase> samples = sampled({}, {kFriction}, {.rule = Rule::sobol, .points = 8});
  EXPECT_EQ(std::ranges::count(samples, true, &LoadCase::first_half), 4);
  std::vector<Barred> numbers;
  double half = 0, whole = 0, most_of_half = 0, most = 0;
  for (const LoadCase& sample : samples) {
    const double value = std::exp(10 * sample.changes[0].value);
    numbers.push_back({.value = value, .bar = 0.5});
    whole += value / 8;
    most = std::max(most, value);
    if (sample.first_half) {
      half += value / 4;
      most_of_half = std::max(most_of_half, value);
    }
  }
  EXPECT_NEAR(over_cases("mean", samples, numbers, 0.5).bar, 0.5 + std::abs(whole - half), 1e-9);
  EXPECT_NEAR(over_cases("worst", samples, numbers, 0.5).bar, 0.5 + most - most_of_half, 1e-9);
  EXPECT_NEAR(over_cases("sum", samples, numbers, 0.5).bar, 0.5 + std::abs(whole - half), 1e-9);
  EXPECT_GT(std::abs(whole - half), 1e-3);
  // Corners and Gauss rules are no sequence.
  for (const Rule rule : {Rule::corners, Rule::gauss})
    for (const LoadCase& sample : sampled({}, {kFriction}, {.rule = rule})) EXPECT_FALSE(sample.first_half);
}

TEST(OverCases, DeviationAndQuantile) {
  std::vector<LoadCase> cases(5);
  std::vector<Barred> numbers;
  for (int i = 0; i < 5; ++i) numbers.push_back({.value = static_cast<double>(5 - i), .bar = 0.1});
  EXPECT_NEAR(over_cases("deviation", cases, numbers, 0.5).value, std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(over_cases("quantile", cases, numbers, 0.5).value, 3, 1e-12);
  EXPECT_NEAR(over_cases("quantile", cases, numbers, 0.7).value, 4, 1e-12);
  EXPECT_NEAR(over_cases("quantile", cases, numbers, 0.01).value, 1, 1e-12);
  EXPECT_NEAR(over_cases("quantile", cases, numbers, 0.999).value, 5, 1e-12);
  EXPECT_EQ(over_cases("quantile", cases, numbers, 0.5).bar, 0.1);
}

}  // namespace
}  // namespace dovetail::optimizer
