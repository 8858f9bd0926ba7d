#include "optimizer/search/run.hpp"

#include <gtest/gtest.h>

#include <mutex>
#include <set>
#include <string>
#include <thread>

#include "bowl.hpp"
#include "core/errors.hpp"
#include "scratch_file.hpp"

namespace dovetail::optimizer {
namespace {

class Run : public ScratchFile {};

TEST_F(Run, EvaluatesTheStartExactlyAndFirst) {
  Problem problem = bowl_problem();
  problem.space = DesignSpace(
      {{.key = "a", .lower = 0.1, .upper = 0.7, .start = 0.3}, {.key = "b", .lower = -3, .upper = 10, .start = 0.1}});
  const OptimizationResult result = run_optimization(problem, bowl, bowl_options(Algorithm::cobyla));
  EXPECT_EQ(result.evaluations[0].x, (std::vector{0.3, 0.1}));
  EXPECT_EQ(result.evaluations[0].phase, "start");
  EXPECT_EQ(result.evaluations[0].evaluation.parameters.at("b"), 0.1);
}

TEST_F(Run, NeverEvaluatesTheSameCandidateTwice) {
  for (const Algorithm algorithm :
       {Algorithm::cobyla, Algorithm::bobyqa, Algorithm::slsqp, Algorithm::ipopt, Algorithm::direct_l}) {
    const OptimizationResult result = run_optimization(bowl_problem(), bowl, bowl_options(algorithm));
    std::set<std::vector<double>> seen;
    for (const Candidate& candidate : result.evaluations)
      EXPECT_TRUE(seen.insert(candidate.x).second) << to_string(algorithm);
  }
}

TEST_F(Run, KeepsTheBudget) {
  for (const int budget : {1, 2, 5, 7, 20}) {
    OptimizerOptions options = bowl_options(Algorithm::slsqp);
    options.max_evaluations = budget;
    const OptimizationResult result = run_optimization(bowl_problem(), bowl, options);
    EXPECT_EQ(result.evaluations.size(), static_cast<std::size_t>(budget));
    EXPECT_EQ(result.status, Status::iteration_limit);
  }
}

TEST_F(Run, HandlesOneVariable) {
  Problem problem;
  problem.space = DesignSpace({{.key = "x", .lower = -2, .upper = 4, .start = 3}});
  problem.objective = {{.response = "f"}};
  problem.constraints = {{.response = "f", .lower = {}, .upper = 100}};
  const Evaluator evaluator = [](std::span<const double> x) {
    Evaluation e;
    e.responses["f"] = 2 + (x[0] - 1) * (x[0] - 1);
    return e;
  };
  for (const Algorithm algorithm : all_algorithms()) {
    OptimizerOptions options;
    options.algorithm = algorithm;
    options.max_evaluations = 150;
    const OptimizationResult result = run_optimization(problem, evaluator, options);
    ASSERT_TRUE(result.best) << to_string(algorithm);
    // Of 150 random points the nearest is within 2.5 times the mean distance 6/150 in all but one of 10^2 samples.
    EXPECT_LT(result.evaluations[*result.best].judgement.objective, 2 + 1e-2)
        << to_string(algorithm) << ": " << result.message;
  }
}

TEST_F(Run, StartsTheAlgorithmFromTheBestOfTheScan) {
  const OptimizerOptions options = bowl_options(Algorithm::cobyla);
  const OptimizationResult result = run_optimization(bowl_problem(), bowl, options);
  std::size_t best = 0;
  double least = kInfinity;
  for (std::size_t i = 0; i < 7; ++i) {
    EXPECT_EQ(result.evaluations[i].phase, i == 0 ? "start" : "scan");
    if (result.evaluations[i].judgement.feasible && result.evaluations[i].judgement.objective < least) {
      best = i;
      least = result.evaluations[i].judgement.objective;
    }
  }
  // The first step of cobyla changes one variable by initial_step.
  ASSERT_EQ(result.evaluations[7].phase, "cobyla");
  EXPECT_NEAR(result.evaluations[7].x[0] - result.evaluations[best].x[0], 0.2 * 4, 1e-9);
  EXPECT_NEAR(result.evaluations[7].x[1], result.evaluations[best].x[1], 1e-9);
}

TEST_F(Run, GivesTheSameJournalHoweverManyAreComputedAtOnce) {
  OptimizerOptions options = bowl_options(Algorithm::slsqp);
  options.scan_evaluations = 25;
  std::string one;
  for (const std::size_t at_once : {1, 2, 5}) {
    std::filesystem::remove(file);
    Journal journal = Journal::create(file, "k");
    RunHooks hooks{.journal = &journal};
    if (at_once > 1) hooks.many = in_batches(bowl, at_once);
    static_cast<void>(run_optimization(bowl_problem(), bowl, options, hooks));
    if (at_once == 1) one = contents();
    EXPECT_EQ(contents(), one) << at_once;
  }
}

TEST_F(Run, KeepsFinishedCandidatesWhenStoppedWithSomeUnderWay) {
  OptimizerOptions options = bowl_options(Algorithm::scan);
  options.scan_evaluations = 40;
  std::atomic<bool> stop = false;
  int calls = 0;
  Journal journal = Journal::create(file, "k");
  const Evaluator evaluator = [&](std::span<const double> x) {
    if (++calls == 10) stop = true;
    return bowl(x);
  };
  const OptimizationResult result = run_optimization(
      bowl_problem(), evaluator, options, {.journal = &journal, .stop = &stop, .many = in_batches(evaluator, 3)});
  EXPECT_EQ(result.status, Status::interrupted);
  EXPECT_EQ(result.evaluations.size(), static_cast<std::size_t>(calls));
  EXPECT_EQ(journal.size(), result.evaluations.size());
  EXPECT_LT(calls, 14);
}

TEST_F(Run, RunsTwoSearchesAtOnce) {
  for (const Algorithm algorithm : {Algorithm::ipopt, Algorithm::isres, Algorithm::cobyla}) {
    const OptimizationResult alone = run_optimization(bowl_problem(), bowl, bowl_options(algorithm));
    OptimizationResult results[2];
    {
      std::jthread first([&] { results[0] = run_optimization(bowl_problem(), bowl, bowl_options(algorithm)); });
      std::jthread second([&] { results[1] = run_optimization(bowl_problem(), bowl, bowl_options(algorithm)); });
    }
    for (const OptimizationResult& result : results) {
      ASSERT_EQ(result.evaluations.size(), alone.evaluations.size()) << to_string(algorithm);
      for (std::size_t i = 0; i < result.evaluations.size(); ++i)
        ASSERT_EQ(result.evaluations[i].x, alone.evaluations[i].x) << to_string(algorithm);
    }
  }
}

TEST_F(Run, ReportsProgressInOrder) {
  std::size_t expected = 0;
  double best = kInfinity;
  const RunHooks hooks{.journal = nullptr,
                       .progress =
                           [&](const Progress& progress) {
                             EXPECT_EQ(progress.index, expected++);
                             if (progress.candidate.judgement.feasible)
                               best = std::min(best, progress.candidate.judgement.objective);
                             EXPECT_EQ(progress.best.has_value(), best < kInfinity);
                           },
                       .stop = nullptr};
  const OptimizationResult result = run_optimization(bowl_problem(), bowl, bowl_options(Algorithm::cobyla), hooks);
  EXPECT_EQ(result.evaluations.size(), expected);
  EXPECT_EQ(result.evaluations[*result.best].judgement.objective, best);
}

TEST_F(Run, ReportsEveryWrongInputAtOnce) {
  Problem problem = bowl_problem();
  problem.objective.clear();
  OptimizerOptions options;
  options.max_evaluations = 0;
  try {
    static_cast<void>(run_optimization(problem, bowl, options));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.violations().size(), 2U) << error.what();
  }
}

// Where the objective is flat the best is not the first that was seen, and the message says how it was chosen.
TEST_F(Run, BreaksTiesByTheMarginAgainstSlip) {
  Problem problem = bowl_problem();
  const auto flat = [](std::span<const double> x) {
    Evaluation e = bowl(x);
    e.responses["bowl"] = 0;
    e.model[kSlipMargin] = 1 - std::abs(x[1] - 3) / 10;
    return e;
  };
  OptimizerOptions options;
  options.algorithm = Algorithm::scan;
  options.max_evaluations = 20;
  const OptimizationResult result = run_optimization(problem, flat, options);
  ASSERT_TRUE(result.best);
  for (const Candidate& candidate : result.evaluations)
    EXPECT_LE(std::abs(result.evaluations[*result.best].x[1] - 3), std::abs(candidate.x[1] - 3));
  EXPECT_NE(*result.best, 0U);
  EXPECT_NE(result.message.find("designs have the same objective: the best of them is the one farthest from slip"),
            std::string::npos)
      << result.message;
}

}  // namespace
}  // namespace dovetail::optimizer
