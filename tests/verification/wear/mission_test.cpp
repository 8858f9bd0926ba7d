// The worn flanks of several loads, found directly, against a history in which they alternate.
#include "wear/mission/mission.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "scenes.hpp"
#include "wear/measures.hpp"
#include "wear/wearing_joint.hpp"

namespace dovetail::wear {
namespace {

MissionLoad load_of(const reduction::ReducedModel& model, double share) {
  return {.joint = {.model = std::make_shared<const dynamics::CondensedModel>(model),
                    .options = {.harmonics = 3, .samples = 64}},
          .omega = 1,
          .share = share};
}

struct Scene {
  std::string name;
  std::vector<MissionLoad> loads;
};

std::vector<MissionLoad> blocks(const std::vector<scenes::Block>& all) {
  std::vector<MissionLoad> loads;
  for (std::size_t i = 0; i < all.size(); ++i)
    loads.push_back(load_of(scenes::block(all[i]), 1.0 + static_cast<double>(i)));
  return loads;
}

std::vector<MissionLoad> punches(const std::vector<scenes::Punch>& all) {
  std::vector<MissionLoad> loads;
  for (const scenes::Punch& punch : all) loads.push_back(load_of(scenes::punch(punch), 1));
  return loads;
}

/// Random blocks and punches under two to four loads that differ in force, load, friction and where they act.
std::vector<Scene> all_scenes() {
  std::vector<Scene> all;
  for (const unsigned number : {1U, 2U, 3U, 4U, 5U, 7U}) {
    const scenes::Block block = scenes::random_block(number);
    scenes::Block weak = block, other_side = block, smooth = block, pressed = block;
    weak.tangential_load *= 0.8;
    other_side.eccentricity = -block.eccentricity;
    smooth.friction *= 0.85;
    pressed.normal_load *= 1.2;
    all.push_back({"block " + std::to_string(number) + ", force and place", blocks({block, weak, other_side})});
    all.push_back({"block " + std::to_string(number) + ", friction and load", blocks({smooth, block, pressed, weak})});
  }
  const scenes::Punch punch;
  for (const double by : {0.7, 0.9}) {
    scenes::Punch weak = punch, heavy = punch, smooth = punch;
    weak.tangential_load *= by;
    heavy.normal_load /= by;
    smooth.friction *= by;
    all.push_back({"punch, force, " + std::to_string(by), punches({punch, weak})});
    all.push_back({"punch, load and friction, " + std::to_string(by), punches({heavy, punch, smooth})});
  }
  return all;
}

/// The end of the alternating history, extrapolated to no increment.
double history_volume(const Scene& scene, const Mission& direct) {
  double volume[2];
  for (const int i : {0, 1}) {
    const MissionHistory history = mission_history(
        scene.loads, {.increment = direct.largest_depth / (i == 0 ? 40 : 80), .rate_fraction = 1e-5, .steps = 20000});
    EXPECT_EQ(history.status, Status::converged) << scene.name;
    EXPECT_TRUE(history.at_rest) << scene.name << " after " << history.steps;
    volume[i] = history.worn_volume;
  }
  return 2 * volume[1] - volume[0];
}

TEST(Mission, EndsWhereAnAlternatingHistoryDoes) {
  int agree = 0, depend = 0, open = 0;
  for (const Scene& scene : all_scenes()) {
    const Mission direct = mission(scene.loads);
    // Of pressures that shift from load to load it may say that it does not know.
    open += direct.verdict != Verdict::asymptote ? 1 : 0;
    if (direct.verdict != Verdict::asymptote) continue;
    ASSERT_GT(direct.worn_volume, 0) << scene.name;
    const double past = history_volume(scene, direct);
    const double apart = std::abs(past / direct.worn_volume - 1);
    RecordProperty(scene.name, std::to_string(apart));
    if (apart <= 0.01)
      ++agree;
    else
      EXPECT_TRUE(direct.order_matters) << scene.name << ": direct " << direct.worn_volume << ", history " << past
                                        << ", in turn " << direct.least_volume << " to " << direct.largest_volume;
    depend += direct.order_matters ? 1 : 0;
    // It is at least as deep as each load alone would wear, and no load wears it further.
    for (const MissionLoad& load : scene.loads) {
      const Asymptote alone = asymptote(load.joint, load.omega, {.arbitration = Arbitration::never});
      EXPECT_GE(direct.worn_volume, 0.99 * alone.worn_volume) << scene.name;
    }
  }
  EXPECT_GE(agree, 12);
  EXPECT_LE(open, 1);
  RecordProperty("order_matters", depend);
}

TEST(Mission, LoadsWithoutWearAskForNoDepth) {
  const scenes::Block block = scenes::random_block(1);
  scenes::Block still = block;
  still.tangential_load *= 1.2;
  still.wear_coefficient = 0;
  const Asymptote alone = asymptote(load_of(scenes::block(block), 1).joint, 1, {.arbitration = Arbitration::never});
  for (const bool first : {true, false}) {
    const std::vector<MissionLoad> loads = first ? blocks({still, block}) : blocks({block, still});
    const Mission both = mission(loads);
    ASSERT_EQ(both.verdict, Verdict::asymptote);
    EXPECT_NEAR(both.worn_volume / alone.worn_volume, 1, 1e-9);
    ASSERT_EQ(both.states.size(), 2U);
    const Watcher unwatched;
    // Each state is that of its load on the worn flanks.
    for (std::size_t k = 0; k < 2; ++k) {
      WearingJoint joint(loads[k].joint, loads[k].omega, unwatched);
      const steady::State state = joint.worn(both.depth, {});
      ASSERT_EQ(state.status, Status::converged);
      EXPECT_NEAR((state.displacement - both.states[k].displacement).norm() / state.displacement.norm(), 0, 1e-6);
    }
  }
}

TEST(Mission, OfOneLoadIsItsAsymptote) {
  const std::vector<MissionLoad> one = blocks({scenes::random_block(1)});
  const Mission direct = mission(one);
  const Asymptote alone = asymptote(one[0].joint, one[0].omega, {.arbitration = Arbitration::never});
  EXPECT_NEAR(direct.worn_volume / alone.worn_volume, 1, 1e-9);
  EXPECT_FALSE(direct.order_matters);
}

}  // namespace
}  // namespace dovetail::wear
