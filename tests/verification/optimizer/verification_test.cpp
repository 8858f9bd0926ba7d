// A design's wear by explicit histories, and directly on a finer mesh, against the answer of the search.
#include "optimizer/verification.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/verification/optimizer/coarse_scene.hpp"

namespace dovetail::optimizer {
namespace {

TEST(Verification, ThreeAnswersAgreeWithinTheirBars) {
  Scene scene = coarse_scene();
  scene.solver.max_jacobians = (1 << 30) + 1;  // four of which are more than an int holds
  const Verification v = verify(SceneEvaluator(scene), scene);
  ASSERT_TRUE(v.converged()) << v.status;
  EXPECT_EQ(v.flank_elements, 24);
  EXPECT_EQ(v.harmonics, 2 * scene.solver.harmonics + 1);
  EXPECT_EQ(v.samples, 2 * scene.solver.samples);
  // Three answers, none of them a copy of another.
  EXPECT_NE(v.direct_volume, v.search_volume);
  EXPECT_NE(v.history_volume, v.search_volume);
  EXPECT_NEAR(v.direct_volume, v.search_volume, v.search_bar);
  EXPECT_NEAR(v.history_volume, v.search_volume, v.search_bar + v.history_bar);
  EXPECT_NEAR(v.history_volume, v.search_volume, v.history_bar + 0.01 * v.search_volume);
  EXPECT_LT(v.profile_difference, 0.1);
  EXPECT_EQ(v.direct_profile.size(), v.history_profile.size());
  EXPECT_GT(v.history_bar, 0);
  EXPECT_GT(v.history_solves, 20);
}

// Those that are handed over, say.
TEST(Verification, MayBeAtGivenSettings) {
  const Scene scene = coarse_scene();
  FinerDesign there{.scene = scene, .reference = scene};
  for (Scene* finer : {&there.scene, &there.reference}) {
    finer->mesh.flank_elements = 18;
    finer->solver.harmonics = 7;
  }
  const Verification v = verify(scene, SceneEvaluator(scene).evaluate(scene), there);
  EXPECT_TRUE(v.converged()) << v.status;
  EXPECT_EQ(v.flank_elements, 18);
  EXPECT_EQ(v.harmonics, 7);
  EXPECT_EQ(v.samples, scene.solver.samples);
  EXPECT_EQ(v.direct_volume, SceneEvaluator(there.reference)
                                 .evaluate(there.scene, kSearch)
                                 .evaluation.responses.at("asymptotic_wear_volume_m3"));
}

// What cases share approximately is not shared by what they are held against.
TEST(Verification, HasTheStressOfItsOwnPreload) {
  Scene scene = coarse_scene();
  scene.solver.prestress = Prestress::cases;
  FinerDesign there{.scene = scene, .reference = scene};
  there.reference.contact.friction *= 1.5;
  const auto direct = [&there](const Scene& at) {
    return SceneEvaluator(there.reference).evaluate(at, kSearch).evaluation.responses.at("asymptotic_wear_volume_m3");
  };
  const Verification v = verify(scene, SceneEvaluator(scene).evaluate(scene), there);
  Scene own = scene;
  own.solver.prestress = Prestress::own;
  EXPECT_EQ(v.direct_volume, direct(own));
  EXPECT_NE(v.direct_volume, direct(scene));
}

// A search whose worn volume is off by more than its bar is found out by either answer.
TEST(Verification, DisagreesWithASearchThatIsOff) {
  const Scene scene = coarse_scene();
  const SceneEvaluator evaluator(scene);
  CandidateResult off = evaluator.evaluate(scene);
  const double bar = off.evaluation.error_estimates.at("asymptotic_wear_volume_m3");
  const double right = off.asymptote->worn_volume;
  off.asymptote->worn_volume = right + 3 * bar;
  const FinerDesign same{.scene = scene, .reference = scene}, finer = twice_as_fine(evaluator, scene);
  EXPECT_THAT(verify(scene, off, finer).status, testing::HasSubstr("finer mesh"));
  // A history may differ by half of the bar, in which mesh and solver are that both share.
  off.asymptote->worn_volume = right + 0.8 * bar;
  EXPECT_THAT(verify(scene, off, same, {.of_bar = 0.5}).status, testing::HasSubstr("history"));
  EXPECT_TRUE(verify(scene, off, same, {.of_bar = 1}).converged());
  // A finer mesh that errs alike does not help.
  off.evaluation.error_estimates["asymptotic_wear_volume_m3"] = 1e-9 * right;
  off.asymptote->worn_volume = right;
  EXPECT_THAT(verify(scene, off, same).status, testing::HasSubstr("history"));
}

TEST(Verification, NeitherHistoryGoesOnWithoutABudget) {
  const Scene scene = coarse_scene();
  const Verification v = verify(SceneEvaluator(scene), scene, {.budgets = 0.005});
  EXPECT_EQ(v.status, "history: budget_spent");
  EXPECT_EQ(v.history_profile.size(), 0);
  EXPECT_GT(v.direct_volume, 0);
}

// The history is asked where the finer settings have no answer, too, and what it contradicts is told first.
TEST(Verification, AFinerMeshWithoutAnAnswerHidesNoHistory) {
  const Scene scene = coarse_scene();
  FinerDesign none{.scene = scene, .reference = scene};
  none.scene.solver.max_jacobians = 1;
  CandidateResult result = SceneEvaluator(scene).evaluate(scene);
  Verification v = verify(scene, result, none);
  EXPECT_THAT(v.status, testing::StartsWith("finer mesh: "));
  EXPECT_EQ(v.direct_profile.size(), 0);
  EXPECT_EQ(v.history_profile.size(), result.asymptote->depth.size());
  result.evaluation.error_estimates["asymptotic_wear_volume_m3"] = 1e-9 * v.search_volume;
  v = verify(scene, result, none);
  EXPECT_THAT(v.status, testing::HasSubstr("history"));
}

}  // namespace
}  // namespace dovetail::optimizer
