#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "finer_bowls.hpp"
#include "two_bowls.hpp"

namespace dovetail::optimizer {
namespace {

// A start that breaks its limit costs the search nothing but a look where finer meshes change nothing.
TEST(FinerLimitsOf, AStartThatBreaksItsLimitIsNoReasonToSearchLess) {
  OptimizerOptions some = short_search();
  some.scan_evaluations = 0;
  for (const Algorithm algorithm : {Algorithm::cobyla, Algorithm::slsqp, Algorithm::ipopt}) {
    SCOPED_TRACE(to_string(algorithm));
    some.algorithm = algorithm;
    some.max_evaluations = 200;
    const RunHooks hooks{.finer = [](std::span<const double> x, int) { return bowl(x); }};
    const OptimizationResult result = run_optimization(low_bowl(), bowl, some, hooks);
    EXPECT_EQ(result.status, Status::converged) << result.message;
    ASSERT_TRUE(result.best) << result.message;
    EXPECT_NEAR(result.evaluations[*result.best].judgement.objective, 1 + 1.0 / 9, 1e-3);
    EXPECT_LE(result.finer.size(), 3U);  // of the first that keeps it, and of the best twice
  }
  Problem far = two_bowls();  // the start breaks x >= 2.7
  far.constraints.front().lower = 2.7;
  some.algorithm = Algorithm::nsga2;
  some.max_evaluations = 120;
  const RunHooks hooks{.finer = [](std::span<const double> x, int) { return two_bowls_at(x); }};
  const OptimizationResult result = run_optimization(far, two_bowls_at, some, hooks);
  EXPECT_EQ(result.evaluations.size(), 120U);
  EXPECT_TRUE(result.best) << result.message;
}

// Little that changes at such a start leads the search to where limits are kept on finer meshes at once.
TEST(FinerLimitsOf, AStartThatBreaksItsLimitIsAGuideWhereLittleChanges) {
  OptimizerOptions some = short_search();
  some.scan_evaluations = 0;
  const RunHooks hooks{.finer = [](std::span<const double> x, int) {
    Evaluation e = bowl(x);
    e.responses["height"] += 0.1;
    return e;
  }};
  const OptimizationResult result = run_optimization(low_bowl(), bowl, some, hooks);
  ASSERT_TRUE(result.best) << result.message;
  ASSERT_EQ(result.finer.size(), 3U);
  EXPECT_EQ(result.finer.front().candidate, 0U);
  EXPECT_EQ(result.finer[1].candidate, *result.best);
}

// What is kept for looks is spent before a front says that its budget is used up.
TEST(FinerLimitsOf, AFrontSpendsItsWholeBudget) {
  OptimizerOptions some = short_search();
  some.algorithm = Algorithm::nsga2;
  some.max_evaluations = 120;
  for (const double change : {0.0, -9.0}) {  // of those that come after the first: all hold, or none
    SCOPED_TRACE(change);
    const FinerEvaluator first = first_changes(two_bowls_at, "x", -9);
    const RunHooks hooks{.finer = [&](std::span<const double> x, int level) {
      Evaluation e = first(x, level);
      e.responses["x"] += change;
      return e;
    }};
    const OptimizationResult result = run_optimization(two_bowls(), two_bowls_at, some, hooks);
    EXPECT_EQ(result.best.has_value(), change == 0) << result.message;
    EXPECT_EQ(result.evaluations.size(), 120U) << result.message;
  }
}

/// A run on the bowl, and how many candidates there were at each of its looks.
struct Looked {
  OptimizationResult result;
  std::vector<std::size_t> at;
};

Looked looked(const Problem& problem, const Evaluator& evaluator, const OptimizerOptions& some,
              const FinerEvaluator& finer) {
  Looked run;
  std::size_t known = 0;
  const Evaluator counting = [&](std::span<const double> x) {
    ++known;
    return evaluator(x);
  };
  const RunHooks hooks{.finer = [&](std::span<const double> x, int level) {
    run.at.push_back(known);
    return finer(x, level);
  }};
  run.result = run_optimization(problem, counting, some, hooks);
  return run;
}

// Such a start that says nothing of others leaves half of the budget for the search that knows what finer meshes add.
TEST(FinerLimitsOf, AStartThatIsNoGuideLeavesHalfOfTheBudget) {
  OptimizerOptions some = short_search();
  some.scan_evaluations = 0;
  some.max_evaluations = 40;
  const Looked one = looked(low_bowl(), bowl, some, first_changes(bowl, "height", 9));
  ASSERT_GT(one.at.size(), 1U);
  EXPECT_EQ(one.at[0], 1U);
  EXPECT_EQ(one.at[1], 20U);
  EXPECT_TRUE(one.result.best) << one.result.message;
  EXPECT_GT(one.result.evaluations.size(), 20U);

  Problem far = two_bowls();
  far.constraints.front().lower = 2.7;
  some.algorithm = Algorithm::nsga2;
  some.max_evaluations = 120;
  const Looked front = looked(far, two_bowls_at, some, first_changes(two_bowls_at, "x", -9));
  ASSERT_GT(front.at.size(), 1U);
  EXPECT_EQ(front.at[1], 60U);
  EXPECT_TRUE(front.result.best) << front.result.message;
  EXPECT_EQ(front.result.evaluations.size(), 120U);
}

// Whoever was refused by what a look found led the search: it begins anew with its first step.
TEST(FinerLimitsOf, ASearchThatIsRefusedBeginsAnewWithItsFirstStep) {
  OptimizerOptions some = short_search();
  some.scan_evaluations = 0;
  Problem problem = low_bowl();
  problem.space = DesignSpace({{.key = "geometry.a_um", .lower = -1, .upper = 3, .start = 0},
                               {.key = "geometry.b_deg", .lower = 0, .upper = 10, .start = 2}});
  // The first look refuses everyone; those that come after change nothing.
  const Looked run = looked(problem, bowl, some, first_changes(bowl, "height", 9));
  ASSERT_GT(run.at.size(), 1U);
  std::size_t refused = 0;  // the first look after the one at the start
  while (refused < run.at.size() && run.at[refused] == run.at[0]) ++refused;
  ASSERT_LT(refused, run.at.size());
  std::size_t best = 0;  // of those known then, by what is known of limits then
  for (std::size_t i = 0; i < run.at[refused]; ++i) {
    const Evaluation& one = run.result.evaluations[i].evaluation;
    if (one.responses.at("height") + 0.01 <= 3 &&
        one.responses.at("bowl") < run.result.evaluations[best].evaluation.responses.at("bowl"))
      best = i;
  }
  ASSERT_LT(run.at[refused], run.result.evaluations.size()) << "the search did not go on";
  const std::vector<double>&from = run.result.evaluations[best].x, &next = run.result.evaluations[run.at[refused]].x;
  EXPECT_NEAR(std::abs(next[0] - from[0]) / 4 + std::abs(next[1] - from[1]) / 10, some.initial_step, 1e-9);
}

// Without an answer nothing is learned, and what was known of limits stays: nobody is looked at who would break them.
TEST(FinerLimitsOf, ALookWithoutAnswerForgetsNothing) {
  const FinerEvaluator finer = [](std::span<const double> x, int) {
    if (x[0] > 0.9) return failed();
    Evaluation e = bowl(x);
    e.responses["height"] += 0.2;
    return e;
  };
  const OptimizationResult result = run_optimization(low_bowl(), bowl, short_search(), {.finer = finer});
  ASSERT_TRUE(result.best) << result.message;
  bool unanswered = false;
  for (const FinerCheck& check : result.finer) {
    unanswered = unanswered || !check.evaluation.converged();
    EXPECT_TRUE(!unanswered || check.held || !check.evaluation.converged()) << check.candidate;
  }
  EXPECT_TRUE(unanswered);
}

// A scan has no search that could go on: of what it found others are looked at, those that were refused by what the
// first ones change, too.
TEST(FinerLimitsOf, AScanSettlesForAnother) {
  OptimizerOptions some = bowl_options(Algorithm::scan);
  some.max_evaluations = 100;
  some.scan_evaluations = 60;
  std::vector<std::vector<double>> seen;
  const FinerEvaluator finer = [&](std::span<const double> x, int) {
    const std::vector<double> here(x.begin(), x.end());
    if (std::ranges::find(seen, here) == seen.end()) seen.push_back(here);
    Evaluation e = bowl(x);
    e.responses["height"] += seen.size() <= 8 ? 9 : 0.01;
    return e;
  };
  const OptimizationResult result = run_optimization(low_bowl(), bowl, some, {.finer = finer});
  ASSERT_TRUE(result.best) << result.message;
  EXPECT_EQ(result.evaluations.size(), 61U);
  EXPECT_EQ(result.evaluations[*result.best].x, seen.back());
  EXPECT_EQ(result.status, Status::converged);
}

}  // namespace
}  // namespace dovetail::optimizer
