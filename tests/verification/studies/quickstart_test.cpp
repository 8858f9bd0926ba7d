// What the quickstart study promises: an optimum beyond its error bar, better than chance, at an active limit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "optimizer/run.hpp"
#include "studies/program/engine.hpp"
#include "studies/program/study.hpp"

namespace dovetail::studies {
namespace {

constexpr const char* kVolume = "asymptotic_wear_volume_m3";

struct Run {
  Study study = load_study(QUICKSTART);
  std::shared_ptr<const optimizer::SceneEvaluator> evaluator = scene_evaluator(study);
  optimizer::Evaluator evaluate = optimizer::over_design_space(*evaluator, study.scene, study.problem.space);
  optimizer::OptimizationResult result = run_optimization(study.problem, evaluate, study.optimizer);
};

const Run& run() {
  static const Run instance;
  return instance;
}

const optimizer::Evaluation& best() {
  return run().result.evaluations[*run().result.best].evaluation;
}

TEST(Quickstart, BestBeatsTheStartBeyondBothErrorBars) {
  ASSERT_TRUE(run().result.best.has_value());
  const optimizer::Evaluation& start = run().result.evaluations.front().evaluation;
  ASSERT_TRUE(start.converged() && start.feasible);
  const double bars = start.error_estimates.at(kVolume) + best().error_estimates.at(kVolume);
  std::printf("start %.4g +- %.2g, best %.4g +- %.2g m3\n", start.responses.at(kVolume),
              start.error_estimates.at(kVolume), best().responses.at(kVolume), best().error_estimates.at(kVolume));
  EXPECT_LT(best().responses.at(kVolume), start.responses.at(kVolume) - bars);
}

TEST(Quickstart, HasAnActiveConstraintAtTheBest) {
  double nearest = -1;
  for (const std::string& name : constraint_names(run().study.problem))
    nearest = std::max(nearest, best().constraints.at(name));
  EXPECT_LE(nearest, 0);
  EXPECT_GT(nearest, -0.01);
}

TEST(Quickstart, BestBeatsAsManyRandomFeasibleDesigns) {
  const auto count = static_cast<int>(run().result.evaluations.size());
  const optimizer::OptimizationResult random =
      random_search(run().study.problem, run().evaluate, count, run().study.optimizer);
  ASSERT_TRUE(random.best.has_value());
  const auto feasible = std::count_if(random.evaluations.begin(), random.evaluations.end(),
                                      [](const optimizer::Candidate& c) { return c.judgement.feasible; });
  const double theirs = random.evaluations[*random.best].evaluation.responses.at(kVolume);
  std::printf("best of %ld random feasible designs (%zu drawn): %.4g m3\n", static_cast<long>(feasible),
              random.evaluations.size(), theirs);
  EXPECT_LT(best().responses.at(kVolume), theirs);
}

TEST(Quickstart, FewCandidatesFail) {
  // A candidate that does not converge is lost to the search: at most one in twenty.
  const optimizer::SearchStatistics& statistics = run().result.statistics;
  EXPECT_LE(20 * statistics.failed, static_cast<int>(run().result.evaluations.size()));
}

}  // namespace
}  // namespace dovetail::studies
