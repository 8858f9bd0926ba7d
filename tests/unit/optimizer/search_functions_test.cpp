#include "optimizer/search/search_functions.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "bowl.hpp"

namespace dovetail::optimizer {
namespace {

/// A session on the bowl that has computed its start, (0, 8): objective 1 + 1 + 16/9.
class SearchView : public ::testing::Test {
 protected:
  static constexpr double kScale = 2 + 16.0 / 9;
  SearchFunctions& functions(Evaluator chosen) {
    evaluator = std::move(chosen);
    options.noise = 1e-12;
    options.constraint_margin = 0.01;
    session.emplace(problem, evaluator, options, hooks);
    session->evaluate_start();
    view.emplace(*session, "test");
    return *view;
  }
  Problem problem = bowl_problem();
  OptimizerOptions options;
  RunHooks hooks;
  Evaluator evaluator;
  std::optional<EvaluationSession> session;
  std::optional<SearchFunctions> view;
};

TEST_F(SearchView, ScalesTheObjectiveAndShiftsTheConstraints) {
  const SearchValue value = functions(bowl).value(std::vector{0.5, 0.4});
  EXPECT_TRUE(value.computed);
  EXPECT_NEAR(value.objective, 1 / kScale, 1e-12);
  ASSERT_EQ(value.constraints.size(), 2U);
  EXPECT_NEAR(value.constraints[0], (4.0 - 6) / 6 + 0.01, 1e-12);
  EXPECT_NEAR(value.constraints[1], -0.01, 1e-12);
}

TEST_F(SearchView, GrowsWithTheViolationOutsideTheGeometry) {
  SearchFunctions& seen = functions([](std::span<const double> x) { return x[0] > 2 ? broken(x[0] - 2) : bowl(x); });
  const SearchValue slight = seen.value(std::vector{0.8, 0.4});
  const SearchValue deep = seen.value(std::vector{1.0, 0.4});
  EXPECT_FALSE(slight.computed);
  EXPECT_GT(slight.objective, 1);  // the level is the start, scaled to 1
  EXPECT_NEAR(deep.objective - slight.objective, 0.8, 1e-9);
  EXPECT_NEAR(deep.constraints[1], 1, 1e-9);
  EXPECT_NEAR(deep.constraints[0], (8.0 - 6) / 6 + 0.01, 1e-12);
}

TEST_F(SearchView, RanksFailuresBelowBrokenRulesOfOrdinarySize) {
  SearchFunctions& seen = functions([](std::span<const double> x) {
    if (x[0] > 2.5) return failed();
    return x[0] > 2 ? broken(x[0] - 2) : bowl(x);
  });
  EXPECT_GT(seen.value(std::vector{1.0, 0.4}).objective, seen.value(std::vector{0.87, 0.4}).objective);
  EXPECT_GT(seen.value(std::vector{1.0, 0.4}).constraints[1], 0);
}

TEST_F(SearchView, DifferencesAgreeWithTheDerivative) {
  SearchFunctions& seen = functions(bowl);
  for (const double u : {0.3, 1.0}) {  // inside, and at the upper bound where the step turns round
    const SearchGradient gradient = seen.gradient(std::vector{u, 0.6});
    const double x = -1 + 4 * u;
    // Truncation h f''/2 = 1e-6 * 32/kScale, noise of rounding 1e-16/2e-6.
    EXPECT_NEAR(gradient.objective[0], 4 * 2 * (x - 1) / kScale, 2e-5);
    EXPECT_NEAR(gradient.objective[1], 10 * 2 * (6.0 - 4) / 9 / kScale, 2e-5);
    EXPECT_NEAR(gradient.constraints[0][0], 0, 1e-8);
    EXPECT_NEAR(gradient.constraints[0][1], 10.0 / 6, 1e-8);
    EXPECT_EQ(gradient.constraints[1][0], 0);
  }
  EXPECT_EQ(session->statistics().gradient_fallbacks, 0);
}

TEST_F(SearchView, TurnsRoundAtAFailingNeighbourAndGivesUpBetweenTwo) {
  const double x = -1 + 4 * 0.5;
  SearchFunctions& above =
      functions([x](std::span<const double> at) { return at[0] > x + 1e-9 ? failed() : bowl(at); });
  EXPECT_NEAR(above.gradient(std::vector{0.5, 0.6}).objective[0], 0, 2e-5);
  EXPECT_EQ(session->statistics().gradient_fallbacks, 0);
  SearchFunctions& both = functions(
      [](std::span<const double> at) { return std::abs(at[0] - 0.2) < 1e-9 || at[0] == 0 ? bowl(at) : failed(); });
  const SearchGradient gradient = both.gradient(std::vector{0.3, 0.6});
  EXPECT_EQ(gradient.objective[0], 0);
  EXPECT_NE(gradient.objective[1], 0);
  EXPECT_EQ(session->statistics().gradient_fallbacks, 1);
}

TEST_F(SearchView, AnswersAFewLastBitsAwayFromTheCache) {
  SearchFunctions& seen = functions(bowl);
  static_cast<void>(seen.value(std::vector{0.3, 0.6}));
  static_cast<void>(seen.value(std::vector{std::nextafter(0.3, 1.0), std::nextafter(0.6, 0.0)}));
  EXPECT_EQ(session->candidates().size(), 2U);
  EXPECT_EQ(session->statistics().repeated, 1);
}

}  // namespace
}  // namespace dovetail::optimizer
