// `wear --method asymptote` and `evaluate` ask one rule where wear comes to rest.
#include <gtest/gtest.h>

#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "optimizer/evaluator.hpp"
#include "studies/program/engine/engine.hpp"
#include "studies/program/engine/loaded_model.hpp"
#include "studies/program/engine/wear_methods.hpp"
#include "studies/program/study_file/study.hpp"
#include "wear/measures.hpp"

namespace dovetail::studies {
namespace {

using Design = std::map<std::string, std::string>;

std::vector<std::string> set(const Design& design) {
  std::vector<std::string> options;
  for (const auto& [key, value] : design) options.push_back(key + "=" + value);
  return options;
}

WearAnswer asymptote(const LoadedModel& loaded, double hz) {
  WearOptions options;
  options.method = WearMethod::asymptote;
  options.follow = Drive::fixed;
  return wear_answer(options, loaded, wear_start_at(hz), {});
}

/// Expects the command to end where the evaluation does, and returns that.
wear::Asymptote agreed(const Design& design) {
  const Study study = load_study(QUICKSTART, overrides(set(design)));
  const optimizer::CandidateResult evaluated = scene_evaluator(study)->evaluate(study.scene, {.bars = false});
  EXPECT_TRUE(evaluated.evaluation.converged()) << evaluated.evaluation.status;
  const WearAnswer answer =
      asymptote(load_model(QUICKSTART, set(design), {}), evaluated.evaluation.model.at("wear_frequency_hz"));
  EXPECT_TRUE(answer.worn_out());
  const wear::Asymptote& command = *answer.asymptote;
  EXPECT_EQ(to_string(command.decided_by), to_string(evaluated.asymptote->decided_by));
  EXPECT_EQ(command.confirmed_by_history, evaluated.asymptote->confirmed_by_history);
  EXPECT_EQ(command.other_states.size(), evaluated.asymptote->other_states.size());
  // The frequency is the same to rounding, and so is the state to the tolerance of its residual.
  EXPECT_NEAR(command.worn_volume, evaluated.asymptote->worn_volume, 1e-4 * evaluated.asymptote->worn_volume);
  return *evaluated.asymptote;
}

// The first history ends with more than twice the direct volume, one with more harmonics and samples next to it.
TEST(WhereWearComesToRest, IsTheSameWhereAFinerHistoryDecides) {
  const wear::Asymptote worn = agreed({{"geometry.flank_mismatch_um", "23.7"},
                                       {"geometry.flank_crown_um", "-1.3"},
                                       {"geometry.flank_angle_deg", "54.9"},
                                       {"contact.friction", "0.3"},
                                       {"loading.tip_force_n", "2"}});
  EXPECT_EQ(worn.decided_by, wear::FoundBy::release);
  EXPECT_EQ(worn.other_states.size(), 2U);
}

// The history ends within a node of the direct answer.
TEST(WhereWearComesToRest, IsTheSameWhereTheHistoryEndsANodeApart) {
  const Design design{{"geometry.flank_mismatch_um", "21.4"},
                      {"geometry.flank_crown_um", "4.5"},
                      {"geometry.flank_angle_deg", "55.6"},
                      {"contact.friction", "0.7"},
                      {"loading.tip_force_n", "1.5"}};
  const wear::Asymptote worn = agreed(design);
  EXPECT_EQ(worn.decided_by, wear::FoundBy::release);
  EXPECT_EQ(worn.other_states.size(), 1U);
  // On nodes of a file, of which it is not known that they end where worn zones do, the history has the last word.
  LoadedModel unknown = load_model(QUICKSTART, set(design), {});
  unknown.lines.clear();
  const WearAnswer answer = asymptote(unknown, worn.unworn.omega / (2 * std::numbers::pi));
  EXPECT_EQ(answer.asymptote->decided_by, wear::FoundBy::history);
  EXPECT_NEAR(answer.volume, worn.other_states.front().worn_volume, 1e-4 * answer.volume);
}

// With rough flanks the history decides at the first frequency; on the way to the resonance of the worn joint nothing
// is in doubt any more, yet what the first pass left open is still said, as far away as it was there.
TEST(WhereWearComesToRest, KeepsOtherStatesAlongResonances) {
  const LoadedModel loaded = load_model(QUICKSTART, {"contact.normal_stiffness_n_per_m3=1e14"}, {});
  WearOptions options;
  options.method = WearMethod::asymptote;
  options.follow = Drive::resonance;
  const WearAnswer answer = wear_answer(options, loaded, wear_start(options, loaded), {});
  ASSERT_TRUE(answer.worn_out());
  const wear::Asymptote& worn = *answer.asymptote;
  EXPECT_EQ(worn.decided_by, wear::FoundBy::history);
  ASSERT_FALSE(worn.other_states.empty());
  for (const wear::OtherState& other : worn.other_states) {
    EXPECT_NEAR(other.worn_volume, wear::worn_volume(loaded.joint.model->contact(), other.depth),
                1e-12 * other.worn_volume);
    EXPECT_NEAR(other.largest_depth, other.depth.maxCoeff(), 1e-12 * other.largest_depth);
  }
}

// What is asked of the numbers of a file alone is asked of that design, stressed by its own preload, not by that of its
// first case.
TEST(LoadedModel, OfAStudyWithCasesIsStressedByItsOwnPreload) {
  Study study = load_study(QUICKSTART);
  study.scene.solver.prestress = optimizer::Prestress::own;
  const LoadedModel alone = load_model(study);
  study.problem.cases = {{.name = "slippery", .changes = {{.key = "contact.friction", .value = 0.3}}}};
  study.scene.solver.prestress = optimizer::Prestress::cases;
  EXPECT_EQ(load_model(study).model.stiffness, alone.model.stiffness);
  study.scene.contact.friction = 0.3;
  EXPECT_NE(load_model(study).model.stiffness, alone.model.stiffness);
}

}  // namespace
}  // namespace dovetail::studies
