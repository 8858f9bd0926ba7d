// Missions where a joint is in space, and where a wear law lets nodes rest in slip: the flanks that all loads leave.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "optimizer/evaluator.hpp"
#include "optimizer/mission/mission_bars.hpp"
#include "optimizer/responses/response_table.hpp"
#include "tests/verification/optimizer/coarse_scene.hpp"
#include "tests/verification/optimizer/sector_joint.hpp"

namespace dovetail::optimizer {
namespace {

/// A coarse sector whose blade is pushed hard enough to wear.
Scene in_space() {
  Scene scene = testing::joint(kSector);
  scene.loading.tip_force = 2;
  return scene;
}

/// Under a threshold of energy: nodes that pass it for a part of the cycle rest in slip.
Scene under_threshold() {
  Scene scene = coarse_scene();
  scene.contact.wear_law = "energy";
  scene.contact.wear.at("energy").threshold = 20;
  return scene;
}

Scene stronger(Scene scene) {
  scene.loading.tip_force *= 1.25;
  scene.loading.speed *= 1.02;
  return scene;
}

MissionLoads loads_of(const std::vector<Scene>& scenes) {
  MissionLoads loads;
  for (const Scene& scene : scenes)
    loads.all.push_back(
        {.name = std::string(1, static_cast<char>('a' + loads.all.size())), .share = 1, .scene = scene});
  return loads;
}

struct Kind {
  std::string name;
  Scene (*scene)();
  double alike;  ///< how far one load by itself and as a mission may lie apart: an edge search of its own each
};

void PrintTo(const Kind& kind, std::ostream* stream) {
  *stream << kind.name;
}

class MissionOfAKind : public ::testing::TestWithParam<Kind> {
 protected:
  SceneEvaluator evaluator_{GetParam().scene()};
};

TEST_P(MissionOfAKind, OfOneLoadIsWhatItWearsOffAlone) {
  const Scene scene = GetParam().scene();
  const Evaluation mission = evaluator_.evaluate_mission(loads_of({scene}), kSearch);
  const Evaluation alone = evaluator_.evaluate(scene, kSearch).evaluation;
  ASSERT_TRUE(mission.converged()) << mission.status;
  ASSERT_TRUE(alone.converged()) << alone.status;
  for (const Response& response : mission_responses()) {
    const std::string own =
        response.name == kMissionDrift.name ? of_case(response.name, "a") : std::string(response.name);
    const double is = mission.responses.at(own), as = alone.responses.at(std::string(response.alone->name));
    EXPECT_NE(as, 0) << own;
    EXPECT_NEAR(is / as, 1, GetParam().alike) << own;
  }
}

// On one grid of nodes for all of them, and no load wears the flanks any further: at least as far as each alone.
TEST_P(MissionOfAKind, WearsAtLeastAsMuchAsEachLoadAlone) {
  const std::vector<Scene> scenes{GetParam().scene(), stronger(GetParam().scene())};
  const MissionLoads loads = loads_of(scenes);
  const MissionResult found = mission_of(loads, models_of(loads, evaluator_.builder()), {});
  const Evaluation& mission = found.evaluation;
  ASSERT_TRUE(mission.converged()) << mission.status;
  EXPECT_EQ(found.models[0].cells.flanks, found.models[1].cells.flanks);
  EXPECT_EQ(found.mission->depth.size(), found.models[0].cells.area.size());
  EXPECT_NEAR(found.models[0].cells.area.dot(found.mission->depth), mission.responses.at("mission_wear_volume_m3"),
              1e-9 * found.mission->worn_volume);
  double largest = 0;
  for (std::size_t k = 0; k < scenes.size(); ++k) {
    const Evaluation alone = evaluator_.evaluate(scenes[k], kSearch).evaluation;
    ASSERT_TRUE(alone.converged()) << alone.status;
    const double volume = alone.responses.at("asymptotic_wear_volume_m3");
    EXPECT_GE(mission.responses.at("mission_wear_volume_m3"), (1 - GetParam().alike - 0.01) * volume) << k;
    largest = std::max(largest, volume);
    // Further worn its resonance has moved further, and not by anything like another mode's.
    EXPECT_LT(mission.responses.at(of_case(kMissionDrift.name, loads.all[k].name)), 0) << k;
    EXPECT_GT(mission.responses.at(of_case(kMissionDrift.name, loads.all[k].name)), -0.05) << k;
  }
  EXPECT_GT(largest, 0);
  EXPECT_LT(mission.responses.at("mission_wear_volume_m3"), 2 * largest);
}

// Where nodes rest in slip the grid is that of the load that wears fastest, wherever it stands.
TEST(MissionUnderAThreshold, HasTheGridOfItsFastestLoad) {
  const Scene weak = under_threshold(), strong = stronger(weak);
  const ModelBuilder builder(weak);
  const auto found = [&](const std::vector<Scene>& scenes) {
    const MissionLoads loads = loads_of(scenes);
    return mission_of(loads, models_of(loads, builder), {});
  };
  const MissionResult alone = found({strong}), last = found({weak, strong}), first = found({strong, weak});
  ASSERT_TRUE(last.evaluation.converged()) << last.evaluation.status;
  EXPECT_EQ(last.models[0].cells.flanks, alone.models[0].cells.flanks);
  EXPECT_EQ(first.models[0].cells.flanks, alone.models[0].cells.flanks);
  // At resonances that are found from other starts.
  EXPECT_NEAR(last.mission->worn_volume / first.mission->worn_volume, 1, 1e-5);
}

INSTANTIATE_TEST_SUITE_P(Mission, MissionOfAKind,
                         ::testing::Values(Kind{"InSpace", in_space, 1e-6},
                                           Kind{"UnderAThreshold", under_threshold, 1e-6}),
                         [](const auto& parameter) { return parameter.param.name; });

}  // namespace
}  // namespace dovetail::optimizer
