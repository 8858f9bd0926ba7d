#include "optimizer/search/front.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <mutex>

#include "core/errors.hpp"
#include "optimizer/journal/fingerprint.hpp"
#include "optimizer/search/pagmo_search.hpp"
#include "optimizer/search/run.hpp"
#include "scratch_file.hpp"
#include "two_bowls.hpp"

namespace dovetail::optimizer {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Candidate candidate(std::vector<double> terms, bool feasible = true, const char* phase = "nsga2") {
  Candidate c;
  c.phase = phase;
  c.judgement.computed = true;
  c.judgement.feasible = c.evaluation.feasible = feasible;
  c.judgement.terms = std::move(terms);
  return c;
}

Problem plain_problem() {
  Problem problem = two_bowls();
  for (ObjectiveTerm& term : problem.objective) term.reference.reset();
  return problem;
}

TEST(Front, IsWhatNoOtherBeats) {
  const std::vector<Candidate> all{candidate({5, 5}, true, kStartPhase),
                                   candidate({1, 4}),
                                   candidate({2, 2}),
                                   candidate({2, 3}),
                                   candidate({2, 2}),
                                   candidate({0, 0}, false),
                                   candidate({4, 1})};
  const Front front = front_of(plain_problem(), all);
  EXPECT_THAT(front.points, ElementsAre(1, 2, 6));
  EXPECT_THAT(front.ideal, ElementsAre(1, 1));
  EXPECT_THAT(front.reference, ElementsAre(5, 5));
  EXPECT_EQ(front.compromise, 2U);
  // Strips from left to right: 1 x 1, 2 x 3, 1 x 4.
  EXPECT_DOUBLE_EQ(front.hypervolume, 11);
}

TEST(Front, TakesOfEqualsTheOneFarthestFromSlip) {
  std::vector<Candidate> all{candidate({0, 0}), candidate({0, 0}), candidate({0, 0})};
  all[1].judgement.slip_margin = all[2].judgement.slip_margin = 0.8;
  EXPECT_THAT(front_of(plain_problem(), all).points, ElementsAre(1));
}

TEST(Front, CountsAgainstTheWorstFeasibleOfStartAndScanUnlessTold) {
  std::vector<Candidate> all{candidate({3, 9}, false, kStartPhase), candidate({3, 7}, true, kScanPhase),
                             candidate({6, 2}, true, kScanPhase), candidate({90, 1})};
  Problem problem = plain_problem();
  EXPECT_THAT(front_of(problem, all).reference, ElementsAre(6, 7));
  EXPECT_FALSE(front_of(problem, all).moves);
  // Against the start alone a front of what is better here and worse there would be worth nothing.
  all[1].phase = all[2].phase = kStartPhase;
  EXPECT_THAT(front_of(problem, all).reference, ElementsAre(90, 7));
  EXPECT_TRUE(front_of(problem, all).moves);
  EXPECT_GT(front_of(problem, all).hypervolume, 0);
  all.resize(1);
  all.push_back(candidate({1, 4}));
  all.push_back(candidate({2, 3}));
  EXPECT_THAT(front_of(problem, all).reference, ElementsAre(2, 4)) << "nothing of start and scan is feasible";
  problem.objective[1].weight = -1;  // maximised
  problem.objective[1].reference = 5;
  EXPECT_THAT(front_of(problem, all).reference, ElementsAre(2, -5));
  EXPECT_TRUE(front_of(problem, all).moves);
  problem.objective[0].reference = 9;
  EXPECT_FALSE(front_of(problem, all).moves);
}

TEST(Front, IsOfAnyNumberOfObjectives) {
  Problem problem = plain_problem();
  problem.objective.push_back({.response = "height", .weight = -1});  // maximised
  const Evaluator evaluator = [](std::span<const double> x) {
    Evaluation e = two_bowls_at(x);
    e.responses["height"] = x[1];
    return e;
  };
  for (const Algorithm algorithm : {Algorithm::nsga2, Algorithm::cobyla})
    for (const int points : {3, 8}) {
      OptimizerOptions options;
      options.algorithm = algorithm;
      options.max_evaluations = 120;
      options.scan_evaluations = 8;
      options.front_points = points;
      const OptimizationResult result = run_optimization(problem, evaluator, options);
      ASSERT_TRUE(result.front) << result.message;
      EXPECT_GT(result.front->points.size(), 5U);
      EXPECT_GT(result.front->hypervolume, 0);
      EXPECT_LT(result.front->ideal[2], -0.8) << "at most 1 is there";
    }
}

TEST(Front, IsEmptyWhereNothingIsFeasible) {
  const Front front = front_of(plain_problem(), std::vector{candidate({1, 2}, false)});
  EXPECT_TRUE(front.points.empty());
  EXPECT_EQ(front.hypervolume, 0);
}

TEST(Front, IsSpreadFromItsEnds) {
  const std::vector<std::vector<double>> terms{{0, 10}, {0.1, 9.9}, {1, 5}, {5, 1}, {9.9, 0.1}, {10, 0}};
  EXPECT_THAT(spread(terms, 2), ElementsAre(0, 5));
  EXPECT_THAT(spread(terms, 4), ElementsAre(0, 2, 3, 5));
  EXPECT_THAT(spread(terms, 50), ElementsAre(0, 1, 2, 3, 4, 5));
}

TEST(Hypervolume, LeavesOutWhatDoesNotReachTheReference) {
  EXPECT_EQ(hypervolume({{2, 2}, {9, 1}, {1, 5}}, {4, 4}), 4);
  EXPECT_EQ(hypervolume({{4, 1}}, {4, 4}), 0);
  EXPECT_EQ(hypervolume({}, {4, 4}), 0);
  EXPECT_EQ(hypervolume({{1, 1, 1}, {0, 2, 2}}, {3, 3, 3}), 8 + 1);
}

OptimizerOptions front_options(Algorithm algorithm) {
  OptimizerOptions options;
  options.algorithm = algorithm;
  options.max_evaluations = 90;
  options.scan_evaluations = algorithm == Algorithm::scan ? 0 : 8;  // a scan alone takes the whole budget
  options.front_points = 5;
  options.population = algorithm == Algorithm::nsga2 ? 12 : 0;
  return options;
}

// Most designs fail, some break the limit, few keep it.
TEST(Front, IsLookedForWhereLimitsBreakRatherThanWhereDesignsFail) {
  const Evaluator evaluator = [](std::span<const double> x) { return x[0] < 0.6 ? two_bowls_at(x) : failed(); };
  OptimizerOptions options = front_options(Algorithm::nsga2);
  options.max_evaluations = 150;
  const OptimizationResult result = run_optimization(two_bowls(), evaluator, options);
  const auto late = result.evaluations.end() - 60;
  EXPECT_LT(std::count_if(late, result.evaluations.end(), [](const Candidate& c) { return !c.judgement.computed; }),
            20);
  EXPECT_TRUE(result.front);
}

class FrontBy : public ScratchFile, public testing::WithParamInterface<Algorithm> {};

TEST_P(FrontBy, IsTheSameBitsForAnyNumberAtOnceAndWhereverTheRunWasKilled) {
  const Problem problem = two_bowls();
  const OptimizerOptions options = front_options(GetParam());
  const std::string key = fingerprint(problem, options);
  OptimizationResult reference;
  {
    Journal journal = Journal::create(file, key);
    reference = run_optimization(problem, two_rough_bowls_at, options, {.journal = &journal});
  }
  ASSERT_TRUE(reference.front);
  const std::string whole = contents();
  for (const double part : {0.02, 0.3, 0.61, 0.97}) {
    overwrite(whole.substr(0, static_cast<std::size_t>(part * static_cast<double>(whole.size()))));
    Journal journal = Journal::resume(file, key);
    const OptimizationResult resumed = run_optimization(
        problem, two_rough_bowls_at, options, {.journal = &journal, .many = in_batches(two_rough_bowls_at, 3)});
    EXPECT_EQ(contents(), whole) << part;
    ASSERT_TRUE(resumed.front);
    EXPECT_EQ(resumed.front->points, reference.front->points);
    EXPECT_EQ(resumed.front->reference, reference.front->reference);
    EXPECT_EQ(resumed.front->hypervolume, reference.front->hypervolume);
    EXPECT_EQ(resumed.best, reference.best);
    EXPECT_EQ(resumed.message, reference.message);
  }
}

TEST_P(FrontBy, KeepsTheBudgetAndLeavesCandidatesJudgedByTheProblem) {
  for (const int budget : {1, 2, 9, 13, 30}) {
    OptimizerOptions options = front_options(GetParam());
    options.max_evaluations = budget;
    const OptimizationResult result = run_optimization(two_bowls(), two_rough_bowls_at, options);
    EXPECT_LE(result.evaluations.size(), static_cast<std::size_t>(budget));
    for (const Candidate& one : result.evaluations) {
      ASSERT_EQ(one.judgement.constraints.size(), 1U);
      if (one.judgement.computed) {
        EXPECT_EQ(one.judgement.objective, one.judgement.terms.front());
      }
    }
  }
}

// More evaluations go on where fewer ended, to the same bits as if they had been there from the start.
TEST_P(FrontBy, GoesOnWithALargerBudget) {
  if (GetParam() == Algorithm::scan) GTEST_SKIP() << "is a hypercube of another size";
  const Problem problem = two_bowls();
  OptimizerOptions options = front_options(GetParam());
  for (const int budget : {40, 90, 133, 240}) {
    options.max_evaluations = budget;
    Journal journal = budget == 40 ? Journal::create(file, "k") : Journal::resume(file, "k");
    const OptimizationResult result = run_optimization(problem, two_rough_bowls_at, options, {.journal = &journal});
    EXPECT_EQ(result.statistics.unused_records, 0) << budget;
    EXPECT_THAT(result.evaluations, testing::SizeIs(budget)) << result.message;
    const OptimizationResult whole = run_optimization(problem, two_rough_bowls_at, options);
    ASSERT_EQ(whole.evaluations.size(), result.evaluations.size());
    for (std::size_t i = 0; i < whole.evaluations.size(); ++i)
      EXPECT_EQ(whole.evaluations[i].x, result.evaluations[i].x);
    ASSERT_TRUE(result.front);
    EXPECT_EQ(whole.front->hypervolume, result.front->hypervolume);
  }
}

TEST(Front, SaysThatItsReferenceMovesWithoutAScan) {
  Problem problem = plain_problem();
  OptimizerOptions options = front_options(Algorithm::cobyla);
  EXPECT_THAT(run_optimization(problem, two_bowls_at, options).message, testing::Not(HasSubstr("reference")));
  options.scan_evaluations = 0;
  const OptimizationResult alone = run_optimization(problem, two_bowls_at, options);
  EXPECT_THAT(alone.message, HasSubstr("without a feasible scan the reference is the worst of start and front"));
  EXPECT_GT(alone.front->hypervolume, 0);
}

TEST_P(FrontBy, KeepsWhatIsFinishedWhenStopped) {
  std::atomic<bool> stop = false;
  int calls = 0;
  const Evaluator evaluator = [&](std::span<const double> x) {
    stop = ++calls == 20;
    return two_bowls_at(x);
  };
  const OptimizationResult result =
      run_optimization(two_bowls(), evaluator, front_options(GetParam()), {.stop = &stop});
  EXPECT_EQ(result.status, Status::interrupted);
  EXPECT_EQ(result.evaluations.size(), 20U);
  EXPECT_TRUE(result.front);
}

INSTANTIATE_TEST_SUITE_P(Optimizer, FrontBy,
                         testing::Values(Algorithm::nsga2, Algorithm::cobyla, Algorithm::bobyqa, Algorithm::slsqp,
                                         Algorithm::ipopt, Algorithm::de, Algorithm::cmaes, Algorithm::scan),
                         [](const auto& parameter) { return std::string(to_string(parameter.param)); });

/// A generation is asked for at once, whole: whatever the cache knows of it is the only thing that is missing.
class Generations : public testing::TestWithParam<Algorithm> {};

TEST_P(Generations, AreComputedAtOnce) {
  const bool front = GetParam() == Algorithm::nsga2;
  const Problem problem = front ? two_bowls() : bowl_problem();
  const Evaluator evaluator = front ? Evaluator(two_bowls_at) : Evaluator(bowl);
  OptimizerOptions options = front_options(GetParam());
  options.population = 12;
  options.max_evaluations = 12 + 6 * 12;
  std::vector<std::size_t> sizes;
  const BatchEvaluator counted = [&](const std::vector<std::vector<double>>& points, const auto& told) {
    sizes.push_back(points.size());
    in_batches(evaluator, 4)(points, told);
  };
  static_cast<void>(run_optimization(problem, evaluator, options, {.many = counted}));
  // The start, the scan, generations; some children of de and nsga2 are their parents again.
  ASSERT_GE(sizes.size(), 7U);
  EXPECT_LE(sizes.size(), 12U);
  for (std::size_t i = 2; i + 1 < sizes.size(); ++i) EXPECT_GE(sizes[i], 6U) << i;
}

INSTANTIATE_TEST_SUITE_P(Optimizer, Generations, testing::Values(Algorithm::nsga2, Algorithm::cmaes, Algorithm::de),
                         [](const auto& parameter) { return std::string(to_string(parameter.param)); });

/// Designs that break a limit would beat all that keep it, and are turned away from.
TEST(Nsga2, StaysWhereLimitsAreKept) {
  Problem problem = two_bowls();
  problem.constraints = {{.response = "height", .lower = 0.5, .upper = {}}};
  const Evaluator evaluator = [](std::span<const double> x) {
    Evaluation e = two_bowls_at(x);
    e.responses["height"] = x[1];
    return e;
  };
  OptimizerOptions options = front_options(Algorithm::nsga2);
  options.max_evaluations = 144;
  const OptimizationResult result = run_optimization(problem, evaluator, options);
  int kept = 0;
  for (std::size_t i = 72; i < 144; ++i) kept += result.evaluations[i].judgement.feasible ? 1 : 0;
  EXPECT_GT(kept, 24) << "of the last 72";
}

/// Beyond the bounds the answer is that of the nearest design: the mean has to come back from there all the same.
TEST(Cmaes, EndsInACorner) {
  Problem problem = bowl_problem();
  problem.constraints.clear();
  const Evaluator evaluator = [](std::span<const double> x) {
    Evaluation e;
    e.responses["bowl"] = std::pow(x[0] - 5, 2) + std::pow(x[1] - 20, 2);
    return e;
  };
  OptimizerOptions options;
  options.algorithm = Algorithm::cmaes;
  options.max_evaluations = 2000;
  const OptimizationResult result = run_optimization(problem, evaluator, options);
  EXPECT_EQ(result.status, Status::converged) << result.message;
  EXPECT_THAT(result.evaluations[*result.best].x, ElementsAre(3, 10));
  // Lost outside it would ask for the corner again and again.
  EXPECT_LT(result.statistics.repeated, static_cast<int>(result.evaluations.size()));
}

std::string refusal(const Problem& problem, const OptimizerOptions& options) {
  try {
    static_cast<void>(run_optimization(problem, bowl, options));
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing";
}

TEST(FrontRefusals, NameTheKeyAndWhatIsAllowed) {
  OptimizerOptions options;
  options.algorithm = Algorithm::nsga2;
  EXPECT_THAT(refusal(bowl_problem(), options), HasSubstr("optimizer.algorithm = nsga2: finds a front and needs"));
  options.population = 10;
  EXPECT_THAT(refusal(two_bowls(), options), HasSubstr("optimizer.population = 10: must be a multiple of 4"));
  options.population = 4;
  EXPECT_THAT(refusal(two_bowls(), options), HasSubstr("or >= 5"));
  options.algorithm = Algorithm::cobyla;
  options.population = 12;
  EXPECT_THAT(refusal(two_bowls(), options), HasSubstr("has a meaning with algorithm"));
  Problem single = bowl_problem();
  single.front = true;
  EXPECT_THAT(refusal(single, {}), HasSubstr("must name several responses for a front"));
}

}  // namespace
}  // namespace dovetail::optimizer
