#include <gtest/gtest.h>

#include "finer_bowls.hpp"
#include "scratch_file.hpp"
#include "two_bowls.hpp"

namespace dovetail::optimizer {
namespace {

class FinerLimits : public ScratchFile {};

TEST(FinerLimitsOf, TheBestDesignHoldOnEveryMesh) {
  const RunHooks hooks{.finer = finer_bowl};
  const OptimizationResult result = run_optimization(low_bowl(), bowl, short_search(), hooks);
  ASSERT_TRUE(result.best) << result.message;
  const Candidate& best = result.evaluations[*result.best];
  for (int level = 1; level <= 2; ++level) EXPECT_LE(finer_bowl(best.x, level).responses.at("height"), 3) << level;
  // Not further from the limit than it has to be: 3 - 0.2 - 0.1 at x = 1, less a fifth of what was made up for.
  EXPECT_GT(best.x[1], 2.5);
  int held = 0;
  for (const FinerCheck& check : result.finer) held += check.candidate == *result.best && check.held ? 1 : 0;
  EXPECT_EQ(held, 2);
  EXPECT_LE(result.evaluations.size(), 60U);
}

TEST(FinerLimitsOf, NothingIsAskedWithoutMeshesOrWithoutLimits) {
  int asked = 0;
  const RunHooks hooks{.finer = [&asked](std::span<const double> x, int level) {
    ++asked;
    return finer_bowl(x, level);
  }};
  OptimizerOptions none = short_search();
  none.finer_meshes = 0;
  EXPECT_TRUE(run_optimization(low_bowl(), bowl, none, hooks).best);
  Problem free = low_bowl();
  free.constraints.clear();
  EXPECT_TRUE(run_optimization(free, bowl, short_search(), hooks).best);
  EXPECT_EQ(asked, 0);
}

TEST(FinerLimitsOf, NoDesignIsHandedOverThatBreaksThemThere) {
  const RunHooks hooks{.finer = [](std::span<const double> x, int) {
    Evaluation e = bowl(x);
    e.responses["height"] += 20;
    return e;
  }};
  const OptimizationResult result = run_optimization(low_bowl(), bowl, short_search(), hooks);
  EXPECT_FALSE(result.best);
  EXPECT_NE(result.message.find("finer"), std::string::npos) << result.message;
}

TEST(FinerLimitsOf, ADesignWithoutAnswerThereIsNotSaidToBreakThem) {
  const RunHooks hooks{.finer = [](std::span<const double>, int) { return failed(); }};
  const OptimizationResult result = run_optimization(low_bowl(), bowl, short_search(), hooks);
  EXPECT_FALSE(result.best);
  EXPECT_NE(result.message.find("finer ones have no answer"), std::string::npos) << result.message;
  EXPECT_EQ(result.message.find("break"), std::string::npos) << result.message;
}

TEST(FinerLimitsOf, ARunThatNeverMetItsLimitsDoesNotBlameFinerMeshes) {
  Problem problem = low_bowl();
  problem.constraints.front().upper = -100;
  const OptimizationResult result = run_optimization(problem, bowl, short_search(), {.finer = finer_bowl});
  EXPECT_FALSE(result.best);
  EXPECT_EQ(result.message.find("finer"), std::string::npos) << result.message;
  EXPECT_EQ(result.message.find("; ;"), std::string::npos) << result.message;
  EXPECT_FALSE(result.message.starts_with(";")) << result.message;
}

/// The bowl with a second limit: few designs keep both.
Evaluation tilted(std::span<const double> x) {
  Evaluation e = bowl(x);
  e.responses["tilt"] = 8 - x[1];
  return e;
}

Problem tilted_bowl() {
  Problem problem = bowl_problem();
  problem.constraints.push_back({.response = "tilt", .lower = {}, .upper = 2.5});
  return problem;
}

/// With next to no scan, which would find who keeps both limits.
OptimizerOptions without_scan(Algorithm algorithm) {
  OptimizerOptions result = short_search();
  result.algorithm = algorithm;
  result.scan_evaluations = 1;
  return result;
}

// What a look adds to the second limit refuses all who keep both on the mesh of the search. They are looked at
// themselves, and break it, too.
TEST(FinerLimitsOf, ARunRefusedByFinerMeshesSaysSo) {
  const RunHooks hooks{.finer = [&](std::span<const double> x, int) {
    Evaluation e = tilted(x);
    e.responses["height"] -= 3;
    e.responses["tilt"] += 2;
    return e;
  }};
  const OptimizationResult result = run_optimization(tilted_bowl(), tilted, without_scan(Algorithm::de), hooks);
  EXPECT_FALSE(result.best);
  ASSERT_GT(result.finer.size(), 1U);
  EXPECT_FALSE(result.finer.back().held);
  EXPECT_NE(result.message.find("limits kept on the search's mesh break on finer ones"), std::string::npos)
      << result.message;
}

// Who keeps the limits must not be refused unseen for what another one changes, and the search goes on as it would have
// without that one.
TEST(FinerLimitsOf, WhatOneDesignChangesDoesNotRefuseOthersForGood) {
  for (const Algorithm algorithm : {Algorithm::de, Algorithm::cobyla, Algorithm::cmaes, Algorithm::ipopt}) {
    SCOPED_TRACE(to_string(algorithm));
    OptimizerOptions many = without_scan(algorithm);
    many.max_evaluations = 150;
    const OptimizationResult result =
        run_optimization(tilted_bowl(), tilted, many, {.finer = first_changes(tilted, "tilt", 9)});
    ASSERT_TRUE(result.best) << result.message;
    EXPECT_NE(result.status, Status::stalled) << result.message;
    const Candidate& best = result.evaluations[*result.best];
    EXPECT_LE(best.evaluation.responses.at("tilt") + 0.01, 2.5);
    EXPECT_NE(best.x, result.evaluations[result.finer.front().candidate].x);
    // The optimum lies at (1, 5.51), and the start at 2.8.
    EXPECT_LT(best.judgement.objective, 1.35) << best.x[0] << ", " << best.x[1];
  }
}

TEST(FinerLimitsOf, WhatOneDesignChangesDoesNotRefuseAFront) {
  const Problem problem = two_bowls();
  for (const Algorithm algorithm : {Algorithm::nsga2, Algorithm::cobyla}) {
    SCOPED_TRACE(to_string(algorithm));
    OptimizerOptions some = short_search();
    some.algorithm = algorithm;
    some.max_evaluations = 200;
    // x is to be 0.5 at least.
    const OptimizationResult result =
        run_optimization(problem, two_bowls_at, some, {.finer = first_changes(two_bowls_at, "x", -9)});
    ASSERT_TRUE(result.best) << result.message;
    EXPECT_NE(result.status, Status::stalled) << result.message;
    EXPECT_EQ(result.message.find("not looked at"), std::string::npos) << result.message;
    EXPECT_GT(result.front->points.size(), 5U);
  }
}

// The time of a run is over for searching on, and for looks at one after the other.
TEST(FinerLimitsOf, FewLooksComeAfterTheTimeOfARun) {
  int evaluations = 0;
  const Evaluator counting = [&](std::span<const double> x) {
    ++evaluations;
    return bowl(x);
  };
  RunHooks hooks{.finer = [](std::span<const double> x, int) {
    Evaluation e = bowl(x);
    e.responses["height"] += 20;
    return e;
  }};
  hooks.time_over = [&] { return evaluations >= 20; };
  const OptimizationResult result = run_optimization(low_bowl(), counting, short_search(), hooks);
  EXPECT_FALSE(result.best);
  EXPECT_LE(result.finer.size(), 8U);
}

// One that held is known to hold: what is seen of another one cannot refuse it any more.
TEST(FinerLimitsOf, ADesignThatHeldIsKeptWhateverLaterLooksSay) {
  std::vector<std::vector<double>> seen;
  const FinerEvaluator finer = [&](std::span<const double> x, int) {
    Evaluation e = bowl(x);
    const std::vector<double> here(x.begin(), x.end());
    if (seen.empty() || seen.back() != here) seen.push_back(here);
    e.responses["height"] += seen.size() > 2 ? 30 : 0.01;  // the first two hold
    return e;
  };
  OptimizerOptions few = short_search();
  few.max_evaluations = 10;
  const OptimizationResult result = run_optimization(low_bowl(), bowl, few, {.finer = finer});
  ASSERT_TRUE(result.best) << result.message;
  EXPECT_GT(seen.size(), 2U);
  EXPECT_EQ(result.evaluations[*result.best].x, seen[1]);
}

// What is kept for a look at finer meshes is no use without a design to look at.
TEST(FinerLimitsOf, ARunThatNeverMeetsItsLimitsSpendsItsWholeBudget) {
  Problem problem = low_bowl();
  problem.constraints[0].upper = -100;
  OptimizerOptions few = short_search();
  few.max_evaluations = 10;
  const OptimizationResult result = run_optimization(problem, bowl, few, {.finer = finer_bowl});
  EXPECT_FALSE(result.best);
  EXPECT_EQ(result.evaluations.size(), 10U);
}

TEST(FinerLimitsOf, ADesignThatFailsThereIsPassedOver) {
  const RunHooks hooks{.finer = [](std::span<const double> x, int) { return x[0] > 0.9 ? failed() : bowl(x); }};
  const OptimizationResult result = run_optimization(low_bowl(), bowl, short_search(), hooks);
  ASSERT_TRUE(result.best) << result.message;
  EXPECT_LE(result.evaluations[*result.best].x[0], 0.9);
}

TEST_F(FinerLimits, AreNotComputedAgainWhenARunGoesOn) {
  int asked = 0;
  const FinerEvaluator finer = [&asked](std::span<const double> x, int level) {
    ++asked;
    return finer_bowl(x, level);
  };
  OptimizationResult first, again;
  {
    Journal journal = Journal::create(file, "key");
    first = run_optimization(low_bowl(), bowl, short_search(), {.finer = finer, .finer_journal = &journal});
  }
  const int before = asked;
  EXPECT_GT(before, 2);
  {
    Journal journal = Journal::resume(file, "key");
    again = run_optimization(low_bowl(), bowl, short_search(), {.finer = finer, .finer_journal = &journal});
  }
  EXPECT_EQ(asked, before);
  EXPECT_EQ(again.best, first.best);
  EXPECT_EQ(again.finer.size(), first.finer.size());
}

}  // namespace
}  // namespace dovetail::optimizer
