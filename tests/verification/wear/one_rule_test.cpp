// `wear --method asymptote` and `evaluate` ask one rule where wear comes to rest.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "optimizer/evaluator.hpp"
#include "studies/program/engine/engine.hpp"
#include "studies/program/engine/wear_methods.hpp"
#include "studies/program/study_file/study.hpp"

namespace dovetail::studies {
namespace {

using Design = std::map<std::string, std::string>;

/// Expects the command to end where the evaluation does, and returns that.
wear::Asymptote agreed(const Design& design) {
  std::vector<Override> overrides;
  for (const auto& [key, value] : design) overrides.push_back({.key = key, .value = value, .origin = "--set"});
  const Study study = load_study(QUICKSTART, overrides);
  const optimizer::CandidateResult evaluated = scene_evaluator(study)->evaluate(study.scene, {.bars = false});
  EXPECT_TRUE(evaluated.evaluation.converged()) << evaluated.evaluation.status;
  WearOptions options;
  options.method = "asymptote";
  options.follow = "fixed";
  const LoadedModel loaded = load_model(QUICKSTART, overrides, {});
  const WearAnswer answer =
      wear_answer(options, loaded, wear_start_at(evaluated.evaluation.model.at("wear_frequency_hz")), {});
  EXPECT_TRUE(answer.worn_out());
  const wear::Asymptote& command = *answer.asymptote;
  EXPECT_EQ(to_string(command.decided_by), to_string(evaluated.asymptote->decided_by));
  EXPECT_EQ(command.confirmed_by_history, evaluated.asymptote->confirmed_by_history);
  EXPECT_EQ(command.other_states.size(), evaluated.asymptote->other_states.size());
  // The frequency is the same to rounding, and so is the state to the tolerance of its residual.
  EXPECT_NEAR(command.worn_volume, evaluated.asymptote->worn_volume, 1e-4 * evaluated.asymptote->worn_volume);
  return *evaluated.asymptote;
}

// The first history ends with twice the direct volume, one with more harmonics and samples in the direct state.
TEST(WhereWearComesToRest, IsTheSameWhereAFinerHistoryDecides) {
  const wear::Asymptote worn = agreed({{"geometry.flank_mismatch_um", "8"},
                                       {"geometry.flank_crown_um", "-2"},
                                       {"geometry.flank_angle_deg", "53"},
                                       {"contact.friction", "0.6"},
                                       {"loading.tip_force_n", "3"}});
  EXPECT_EQ(worn.other_states.size(), 2U);
}

TEST(WhereWearComesToRest, IsTheSameOnFlanksThatHardlyWear) {
  (void)agreed({{"geometry.flank_mismatch_um", "22"}, {"geometry.flank_crown_um", "4.4"}});
}

}  // namespace
}  // namespace dovetail::studies
