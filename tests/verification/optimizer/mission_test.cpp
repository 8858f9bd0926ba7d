// What several loads wear off the same flanks together, with its bars, against single loads, histories and other grids.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "optimizer/candidate/candidate_result.hpp"
#include "optimizer/cases.hpp"
#include "optimizer/evaluator.hpp"
#include "optimizer/mission/mission_bars.hpp"
#include "optimizer/responses/response_table.hpp"
#include "tests/verification/optimizer/coarse_scene.hpp"

namespace dovetail::optimizer {
namespace {

/// The coarse scene at some force, and with speed and friction that differ from its own.
Scene loaded(double force, double speed = 1, double friction = 1) {
  Scene scene = coarse_scene();
  scene.loading.tip_force *= force;
  scene.loading.speed *= speed;
  scene.contact.friction *= friction;
  return scene;
}

MissionLoads of(const std::vector<Scene>& scenes) {
  MissionLoads loads;
  for (std::size_t k = 0; k < scenes.size(); ++k)
    loads.all.push_back({.name = std::string(1, static_cast<char>('a' + k)), .share = 1, .scene = scenes[k]});
  return loads;
}

double value(const Evaluation& evaluation, const std::string& name) {
  return evaluation.responses.at(name);
}

double bar(const Evaluation& evaluation, const std::string& name) {
  return evaluation.error_estimates.at(name);
}

class MissionOfACoarseScene : public ::testing::Test {
 protected:
  SceneEvaluator evaluator_{coarse_scene()};
  [[nodiscard]] Evaluation together(const std::vector<Scene>& scenes, const Purpose& purpose = kSearch) const {
    Evaluation evaluation = evaluator_.evaluate_mission(of(scenes), purpose);
    EXPECT_TRUE(evaluation.converged()) << evaluation.status;
    return evaluation;
  }
};

TEST_F(MissionOfACoarseScene, OfOneLoadIsWhatItWearsOffAlone) {
  const Scene scene = loaded(1);
  const Evaluation mission = together({scene}, {});
  const Evaluation alone = evaluator_.evaluate(scene).evaluation;
  for (const Response& response : mission_responses()) {
    const std::string own =
        response.name == kMissionDrift.name ? of_case(response.name, "a") : std::string(response.name);
    const std::string name(response.alone->name);
    EXPECT_NEAR(value(mission, own), value(alone, name), 1e-9 * std::abs(value(alone, name))) << name;
    // Its bar has the parts of the other's to the last digits - of a drift, the difference of two resonances, as far as
    // these are found - and two of its own: what an alternating history and other orders of the loads say.
    const double found = response.name == kMissionDrift.name ? 0.1 : 1e-6;
    double together = 0;
    for (const auto& [part, bar] : alone.error_sources.at(name)) {
      EXPECT_NEAR(mission.error_sources.at(own).at(part) / bar, 1, found) << name << " " << part;
      together += bar;
    }
    const std::map<std::string, double>& parts = mission.error_sources.at(own);
    EXPECT_EQ(parts.size(), alone.error_sources.at(name).size() + 2) << name;
    EXPECT_LT(parts.at("order"), 1e-9 * std::abs(value(mission, own))) << name << ": of one load there is one order";
    EXPECT_LT(parts.at("history"), 0.05 * std::abs(value(mission, own))) << name;
    EXPECT_NEAR(bar(mission, own), together + parts.at("history"), found * together) << name;
  }
}

TEST_F(MissionOfACoarseScene, OfTwoEqualLoadsIsThatOfOne) {
  const Scene scene = loaded(1);
  const Evaluation one = together({scene}), two = together({scene, scene});
  for (const char* name : {"mission_wear_volume_m3", "mission_wear_depth_max_m", "mission_drift@a"})
    EXPECT_NEAR(value(two, name) / value(one, name), 1, 1e-6) << name;
  EXPECT_EQ(value(two, "mission_drift@a"), value(two, "mission_drift@b"));
}

// No load wears them any further, so they are worn at least as far as each alone would.
TEST_F(MissionOfACoarseScene, WearsAtLeastAsMuchAsEachLoadAlone) {
  const std::vector<std::vector<Scene>> pairs{{loaded(1), loaded(1.5, 1.05)},
                                              {loaded(1), loaded(1, 1, 0.85)},
                                              {loaded(1, 0.9), loaded(0.7), loaded(1.2, 1, 1.2)}};
  for (const std::vector<Scene>& scenes : pairs) {
    const Evaluation mission = together(scenes);
    for (const Scene& scene : scenes) {
      const Evaluation alone = evaluator_.evaluate(scene, kSearch).evaluation;
      ASSERT_TRUE(alone.converged()) << alone.status;
      EXPECT_GE(value(mission, "mission_wear_volume_m3"), 0.99 * value(alone, "asymptotic_wear_volume_m3"));
    }
  }
}

// On nodes half as long: a history wears off whole ones, and ends 4 % deeper on those of the coarse scene, of one load
// as of two.
TEST(Mission, IsConfirmedByAnAlternatingHistory) {
  for (Scene other : {loaded(1.5, 1.05), loaded(1, 1, 0.85)}) {
    Scene scene = loaded(1);
    scene.mesh.flank_elements = other.mesh.flank_elements = 24;
    const Evaluation mission = SceneEvaluator(scene).evaluate_mission(of({scene, other}), {.bars = false});
    ASSERT_TRUE(mission.converged()) << mission.status;
    const double direct = value(mission, "mission_wear_volume_m3");
    EXPECT_EQ(mission.model.at("mission_confirmed_by_history"), 1);
    EXPECT_NEAR(mission.model.at("mission_history_volume_m3"), direct,
                mission.model.at("mission_history_bar_m3") + 0.01 * direct);
    EXPECT_GT(mission.model.at("mission_history_steps"), 20);
  }
}

// What the friction of another load than the first changes in the stress that stiffens the blade is in the bars.
TEST(Mission, HasThePrestressOfItsOtherLoadsInItsBars) {
  Scene scene = loaded(1), other = loaded(1.5);
  scene.solver.prestress = other.solver.prestress = Prestress::cases;
  const auto sources = [&] {
    const Evaluation mission = SceneEvaluator(scene).evaluate_mission(of({scene, other}), {.history = false});
    EXPECT_TRUE(mission.converged()) << mission.status;
    return mission.error_sources.at("mission_wear_volume_m3");
  };
  EXPECT_FALSE(sources().contains("prestress"));
  other.contact.friction *= 0.8;
  EXPECT_TRUE(sources().contains("prestress"));
}

// Worn off by the lighter load first, these flanks stick under the heavier one before it has worn off all it would:
// explicit histories of whole loads in turn end there, too.
TEST_F(MissionOfACoarseScene, SaysWhereTheOrderMatters) {
  Scene light, heavy;
  heavy.loading.speed *= 1.05;
  heavy.loading.tip_force *= 1.5;
  const MissionLoads loads = of({light, heavy});
  Computation how;
  how.history = true;
  const MissionResult found = mission_of(loads, models_of(loads, ModelBuilder(light)), how);
  ASSERT_TRUE(found.evaluation.converged()) << found.evaluation.status;
  EXPECT_TRUE(found.mission->took_turns);
  EXPECT_TRUE(found.mission->order_matters);
  EXPECT_LT(found.mission->least_volume, 0.7 * found.mission->worn_volume);
  EXPECT_EQ(found.mission->largest_volume, found.mission->worn_volume);
  EXPECT_EQ(found.evaluation.model.at("mission_order_matters"), 1);
  ASSERT_FALSE(found.evaluation.messages.empty());
  EXPECT_NE(found.evaluation.messages.back().find("order of the cases matters"), std::string::npos);
}

// Grids are laid for what the loads wear off together: zones end where nodes end.
TEST_F(MissionOfACoarseScene, LaysOneGridForAllLoads) {
  const MissionLoads loads = of({loaded(1), loaded(1.5, 1.05)});
  const MissionResult found = mission_of(loads, models_of(loads, evaluator_.builder()), {});
  ASSERT_TRUE(found.evaluation.converged()) << found.evaluation.status;
  EXPECT_TRUE(found.fit.settled);
  EXPECT_EQ(found.fit.edges, 2);
  EXPECT_EQ(found.models[0].cells.flanks, found.models[1].cells.flanks);
  const double volume = found.mission->worn_volume;
  // A grid of shorter nodes hardly moves it.
  Computation shorter;
  shorter.contact.lengths.finest *= 0.6;
  shorter.contact.lengths.coarsest *= 0.6;
  const MissionResult fine = mission_of(loads, models_of(loads, evaluator_.builder()), shorter);
  ASSERT_TRUE(fine.evaluation.converged()) << fine.evaluation.status;
  EXPECT_NEAR(fine.mission->worn_volume / volume, 1, 0.05);
  EXPECT_GT(fine.mission->depth.size(), found.mission->depth.size());
}

// The matrices of one speed are computed once, however the cases stand in a file. The loads stay in that order.
TEST(MissionLoads, OfOneSpeedAreBuiltSideBySide) {
  const Scene scene = coarse_scene();
  std::vector<LoadCase> cases;
  MissionCases all;
  for (const double force : {1, 2})
    for (const double faster : {1.0, 1.05}) {
      all.cases.push_back(cases.size());
      cases.push_back({.name = std::to_string(cases.size()),
                       .changes = {{.key = "loading.tip_force_n", .value = force},
                                   {.key = "scene.speed_rpm", .value = 0, .times = faster}}});
    }
  const MissionLoads loads = mission_loads(scene, cases, all);
  ASSERT_EQ(loads.all.size(), 4U);
  EXPECT_EQ(loads.all[2].scene.loading.tip_force, 2);
  const std::vector<CandidateModel> models = models_of(loads, ModelBuilder(scene));
  for (std::size_t k = 0; k < models.size(); ++k) {
    ASSERT_TRUE(models[k].converged()) << models[k].status;
    EXPECT_EQ(models[k].model.cosine_force, ModelBuilder(scene).build(loads.all[k].scene).model.cosine_force) << k;
  }
  EXPECT_EQ(models[0].matrices.shared, models[2].matrices.shared);
  EXPECT_EQ(models[1].matrices.shared, models[3].matrices.shared);
  EXPECT_NE(models[0].matrices.shared, models[1].matrices.shared);
}

// Against a mesh three times as fine.
TEST_F(MissionOfACoarseScene, LiesWithinItsBars) {
  const std::vector<Scene> scenes{loaded(1), loaded(1.5, 1.05)};
  const Evaluation mission = together(scenes, {});
  std::vector<Scene> fine = scenes;
  for (Scene& scene : fine) {
    scene = resized(scene, 1.0 / 3);
    scene.solver.harmonics = 11;
    scene.solver.samples = 256;
  }
  const Evaluation truth = SceneEvaluator(fine.front()).evaluate_mission(of(fine), kSearch);
  ASSERT_TRUE(truth.converged()) << truth.status;
  for (const auto& [name, is] : truth.responses) {
    EXPECT_LE(std::abs(value(mission, name) - is), bar(mission, name)) << name;
    EXPECT_LT(bar(mission, name), 0.4 * std::abs(is)) << name << ": a bar that says nothing";
    for (const char* part : {"mesh", "contact_grid", "harmonics", "samples", "pseudo_penalty", "modes"})
      EXPECT_GT(mission.error_sources.at(name).at(part), 0) << name << " " << part;
  }
}

TEST_F(MissionOfACoarseScene, WithoutWearIsNone) {
  const std::vector<Scene> scenes{loaded(1e-4), loaded(2e-4)};
  const Evaluation mission = together(scenes, {});
  EXPECT_EQ(value(mission, "mission_wear_volume_m3"), 0);
  EXPECT_EQ(value(mission, "mission_drift@a"), 0);
  std::vector<LoadCase> cases{{.name = "a", .changes = {}}, {.name = "b", .changes = {}}};
  std::vector<Evaluation> answers;
  for (const Scene& scene : scenes) answers.push_back(evaluator_.evaluate(scene).evaluation);
  answers.push_back(mission);
  const Evaluation all = optimizer::together(cases, scenes.front(), answers, missions_of(cases, true));
  // At least as uncertain as a case by itself.
  EXPECT_EQ(bar(all, "mission_wear_volume_m3@b"), bar(all, "asymptotic_wear_volume_m3@b"));
  EXPECT_GT(bar(all, "mission_wear_volume_m3@b"), 0);
}

// All of a joint slides under one of its loads: no answer, and no silence.
TEST_F(MissionOfACoarseScene, FailsWhereALoadSlides) {
  const Evaluation mission = evaluator_.evaluate_mission(of({loaded(1), loaded(200)}), kSearch);
  EXPECT_FALSE(mission.converged());
  EXPECT_FALSE(mission.responses.contains("mission_wear_volume_m3"));
}

}  // namespace
}  // namespace dovetail::optimizer
