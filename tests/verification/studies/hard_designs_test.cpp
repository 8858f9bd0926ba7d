// Single designs around the quickstart on which evaluations are easily wrong.
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "optimizer/evaluator.hpp"
#include "studies/program/study.hpp"

namespace dovetail::studies {
namespace {

optimizer::CandidateResult evaluated(const std::vector<std::pair<std::string, double>>& changes, bool bars) {
  optimizer::Scene scene = load_study(QUICKSTART, {}).scene;
  for (const auto& [key, value] : changes) optimizer::set_parameter(scene, key, value);
  return optimizer::SceneEvaluator(scene).evaluate(scene, {.bars = bars});
}

// Without friction, or with hardly any, the joint slips all over whatever it has worn.
TEST(HardDesigns, WithHardlyAnyFrictionWearHasNoEnd) {
  for (const double friction : {0.0, 0.01, 0.05}) {
    const optimizer::CandidateResult result = evaluated({{"contact.friction", friction}}, false);
    EXPECT_EQ(result.evaluation.status, "asymptote: no_asymptote") << friction;
    EXPECT_FALSE(result.evaluation.responses.contains("asymptotic_wear_volume_m3")) << friction;
    ASSERT_TRUE(result.asymptote.has_value()) << friction;
    EXPECT_TRUE(result.asymptote->confirmed_by_history) << friction;
  }
}

// A fourteenth of the flanks would bear what is left, at a depth of five times their compression; on a coarser mesh
// nothing does.
TEST(HardDesigns, NearGrossSlidingAWornStateOfOneMeshIsNone) {
  const optimizer::CandidateResult result = evaluated({{"contact.friction", 0.2}, {"loading.tip_force_n", 5}}, true);
  EXPECT_EQ(result.evaluation.status, "asymptote: gross_sliding");
  EXPECT_FALSE(result.evaluation.responses.contains("asymptotic_wear_volume_m3"));
  EXPECT_TRUE(result.evaluation.error_sources.empty());
}

// Enough for the answer itself, not for every companion of its error bars.
TEST(HardDesigns, WithoutItsErrorBarsAnAnswerIsNotConverged) {
  const optimizer::Evaluation evaluation =
      evaluated({{"loading.tip_force_n", 0.5}, {"solver.max_jacobians", 9}}, true).evaluation;
  EXPECT_EQ(evaluation.status, "error_estimates: budget_spent");
  EXPECT_TRUE(evaluation.responses.contains("worn_peak_amplitude_m"));
  EXPECT_FALSE(evaluation.error_estimates.contains("worn_peak_amplitude_m"));
}

}  // namespace
}  // namespace dovetail::studies
