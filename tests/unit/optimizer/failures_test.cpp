#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <stdexcept>
#include <string>

#include "bowl.hpp"
#include "core/errors.hpp"
#include "optimizer/search/run.hpp"
#include "scratch_file.hpp"

namespace dovetail::optimizer {
namespace {

class Failures : public ::testing::TestWithParam<Algorithm> {};

// Without obstacles the bowl's bottom is 1, at (1, 4); global methods with 120 evaluations come within 0.3.
constexpr double kNear = 1.3;

double best_value(const OptimizationResult& result) {
  return result.best ? result.evaluations[*result.best].judgement.objective : kInfinity;
}

TEST_P(Failures, FindsTheWayRoundBrokenRules) {
  // Everything left of x = 0.5 and below y = 2 breaks a rule; the start does, too.
  const Evaluator evaluator = [](std::span<const double> x) {
    const double violation = std::max({0.0, 0.5 - x[0], (2 - x[1]) / 5});
    if (violation > 0) return broken(violation);
    Evaluation e = bowl(x);
    e.constraints["rule:wall"] = std::max(0.5 - x[0], (2 - x[1]) / 5);
    return e;
  };
  const OptimizationResult result = run_optimization(bowl_problem(), evaluator, bowl_options(GetParam()));
  ASSERT_TRUE(result.best) << result.message;
  EXPECT_LT(best_value(result), kNear) << result.message;
  EXPECT_GT(result.statistics.infeasible, 0);
}

TEST_P(Failures, SurvivesCandidatesThatDoNotConverge) {
  const Evaluator evaluator = [](std::span<const double> x) { return x[0] > 1.5 || x[1] > 9 ? failed() : bowl(x); };
  const OptimizationResult result = run_optimization(bowl_problem(), evaluator, bowl_options(GetParam()));
  EXPECT_LT(best_value(result), kNear) << result.message;
  EXPECT_GT(result.statistics.failed, 0);
}

// As when a rule between two keys holds at the bounds of the variables, but not within.
TEST_P(Failures, SurvivesDesignsThatTheEvaluatorRefuses) {
  const Evaluator evaluator = [](std::span<const double> x) {
    if (x[0] > 1.5 || x[1] > 9)
      throw InputError(Violation{.file = {}, .key = "x", .value = "2", .allowed = "must be less"});
    return bowl(x);
  };
  const OptimizationResult result = run_optimization(bowl_problem(), evaluator, bowl_options(GetParam()));
  EXPECT_LT(best_value(result), kNear) << result.message;
  EXPECT_GT(result.statistics.failed, 0);
  for (const Candidate& c : result.evaluations)
    EXPECT_EQ(c.evaluation.status, c.x[0] > 1.5 || c.x[1] > 9 ? "scene: x = 2: must be less" : "converged");
}

TEST_P(Failures, TakesNotANumberAsAFailure) {
  const Evaluator evaluator = [](std::span<const double> x) {
    Evaluation e = bowl(x);
    if (x[0] > 1.5) e.responses["height"] = std::nan("");
    if (x[1] < 2) e.responses["bowl"] = kInfinity;
    return e;
  };
  const OptimizationResult result = run_optimization(bowl_problem(), evaluator, bowl_options(GetParam()));
  EXPECT_LT(best_value(result), kNear) << result.message;
  for (const Candidate& c : result.evaluations) EXPECT_EQ(c.evaluation.converged(), c.x[0] <= 1.5 && c.x[1] >= 2);
}

TEST_P(Failures, EndsWhenNothingCanBeComputed) {
  for (const Evaluation& always : {failed(), broken(0.5)}) {
    const OptimizationResult result = run_optimization(
        bowl_problem(), [&](std::span<const double>) { return always; }, bowl_options(GetParam()));
    EXPECT_FALSE(result.best);
    EXPECT_THAT(result.message, ::testing::HasSubstr(always.infeasible() ? "no candidate meets every constraint"
                                                                         : "no candidate could be computed"));
  }
}

TEST_P(Failures, PassesOnWhatTheEvaluatorThrows) {
  for (const bool at_once : {false, true}) {
    for (const int after : {0, 3, 15}) {
      std::atomic<int> calls = 0;
      const Evaluator evaluator = [&](std::span<const double> x) {
        if (calls++ == after) throw std::out_of_range("disk is gone");
        return bowl(x);
      };
      RunHooks hooks;
      if (at_once) hooks.many = in_batches(evaluator, 2);
      try {
        static_cast<void>(run_optimization(bowl_problem(), evaluator, bowl_options(GetParam()), hooks));
        ADD_FAILURE() << "nothing thrown";
      } catch (const std::out_of_range& error) {
        EXPECT_STREQ(error.what(), "disk is gone");
      }
    }
  }
}

TEST_P(Failures, StopsWhenAskedAndKeepsWhatIsFinished) {
  std::atomic<bool> stop = false;
  const RunHooks hooks{
      .journal = nullptr, .progress = [&](const Progress& progress) { stop = progress.index >= 16; }, .stop = &stop};
  const OptimizationResult result = run_optimization(bowl_problem(), bowl, bowl_options(GetParam()), hooks);
  EXPECT_EQ(result.status, Status::interrupted);
  EXPECT_EQ(result.evaluations.size(), 17U);
  EXPECT_TRUE(result.best);
}

INSTANTIATE_TEST_SUITE_P(Optimizer, Failures, ::testing::ValuesIn(all_algorithms()),
                         [](const auto& parameter) { return std::string(to_string(parameter.param)); });

TEST(RunErrors, RefusesAResponseThatIsNotThere) {
  Problem problem = bowl_problem();
  problem.objective[0].response = "bowel";
  EXPECT_THROW(static_cast<void>(run_optimization(problem, bowl, {})), InputError);
}

TEST(RunErrors, PassesOnWhatTheProgressCallbackThrows) {
  for (const Algorithm algorithm : {Algorithm::cobyla, Algorithm::ipopt}) {
    const RunHooks hooks{.journal = nullptr,
                         .progress =
                             [](const Progress& progress) {
                               if (progress.index == 12) throw std::runtime_error("no terminal");
                             },
                         .stop = nullptr};
    EXPECT_THROW(static_cast<void>(run_optimization(bowl_problem(), bowl, bowl_options(algorithm), hooks)),
                 std::runtime_error);
  }
}

}  // namespace
}  // namespace dovetail::optimizer
