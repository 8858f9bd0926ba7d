// What the quickstart study promises at full size: an optimum beyond its error bar, better than chance, at an active
// limit, that keeps every limit on finer meshes. One test, as each would run the search again.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "optimizer/search/run.hpp"
#include "optimizer/verification.hpp"
#include "studies/program/engine/engine.hpp"
#include "studies/program/study_file/study.hpp"
#include "tests/verification/optimizer/random_search.hpp"

namespace dovetail::studies {
namespace {

constexpr const char* kVolume = "asymptotic_wear_volume_m3";

TEST(Quickstart, KeepsItsPromises) {
  const Study study = load_study(QUICKSTART);
  const RunEngine engine = study_engine(study);
  optimizer::RunHooks hooks;
  hooks.finer = engine.finer;
  const optimizer::OptimizationResult result = run_optimization(study.problem, engine.evaluate, study.optimizer, hooks);
  ASSERT_TRUE(result.best.has_value());
  // A candidate that does not converge is lost to the search: at most one in twenty.
  EXPECT_LE(20 * result.statistics.failed, static_cast<int>(result.evaluations.size()));

  const std::vector<double>& x = result.evaluations[*result.best].x;
  const auto with_bars = [&, evaluator = scene_evaluator(study)](const std::vector<double>& at) {
    optimizer::Scene scene = study.scene;
    for (std::size_t i = 0; i < at.size(); ++i)
      optimizer::set_parameter(scene, study.problem.space.variables()[i].key, at[i]);
    return evaluator->evaluate(scene).evaluation;
  };
  const optimizer::Evaluation start = with_bars(result.evaluations.front().x), best = with_bars(x);
  ASSERT_TRUE(start.converged() && best.converged()) << start.status << " " << best.status;
  const double volume = best.responses.at(kVolume), improvement = start.responses.at(kVolume) - volume;
  std::printf("start %.4g +- %.2g, best %.4g +- %.2g m3\n", start.responses.at(kVolume),
              start.error_estimates.at(kVolume), volume, best.error_estimates.at(kVolume));
  EXPECT_LT(best.error_estimates.at(kVolume), improvement / 3);
  EXPECT_LT(start.error_estimates.at(kVolume), improvement / 3);

  double nearest = -1;
  for (const double constraint : result.evaluations[*result.best].judgement.constraints)
    nearest = std::max(nearest, constraint);
  EXPECT_LE(nearest, 0);
  EXPECT_GT(nearest, -0.01);
  for (const int level : {1, 2}) {
    const optimizer::Evaluation finer = engine.finer(x, level);
    ASSERT_TRUE(finer.converged()) << finer.status;
    const optimizer::Judgement there = optimizer::judge(study.problem, finer, study.optimizer.constraint_tolerance);
    EXPECT_TRUE(there.feasible) << "level " << level;
    EXPECT_NEAR(finer.responses.at(kVolume), volume, best.error_estimates.at(kVolume)) << "level " << level;
  }

  const std::optional<optimizer::Candidate> random = optimizer::best_random(
      study.problem, engine.evaluate, static_cast<int>(result.evaluations.size()), study.optimizer);
  ASSERT_TRUE(random.has_value());
  const double theirs = random->evaluation.responses.at(kVolume);
  std::printf("best of as many random feasible designs: %.4g m3\n", theirs);
  EXPECT_LT(volume, theirs);
}

}  // namespace
}  // namespace dovetail::studies
