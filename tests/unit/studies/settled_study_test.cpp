#include "studies/program/engine/settled_study.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "studies/program/commands/settled_run.hpp"

namespace dovetail::studies {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr const char *kVolume = "asymptotic_wear_volume_m3", *kPressure = "contact_pressure_mean_pa";

using Parts = std::map<std::string, double>;

/// What is told of two responses asked to 2 %; their values are 1, and their bars have these parts.
AccuracyHeld held(const Parts& parts, bool asked_history = true, double pressure = 1,
                  const Parts& of_pressure = {{"mesh", 1e-3}}, bool in_doubt = true) {
  optimizer::Evaluation evaluation;
  evaluation.responses = {{kVolume, 1}, {kPressure, pressure}};
  evaluation.error_sources = {{kVolume, parts}, {kPressure, of_pressure}};
  evaluation.model = {
      {"dofs", 1e4}, {"contact_nodes", 20}, {"jacobians_spent", 9}, {"wear_history_may_differ", in_doubt ? 1 : 0}};
  const optimizer::AccuracyGoal goal{.relative = 0.02, .responses = {kVolume, kPressure}};
  return accuracy_held(optimizer::Scene(), goal, evaluation, asked_history);
}

TEST(AccuracyHeld, CountsEveryPartOfTheBars) {
  EXPECT_TRUE(held({{"mesh", 0.01}}).reached);
  EXPECT_FALSE(held({{"mesh", 0.03}}).reached);
  for (const char* source : {"edge", "history"}) {
    const AccuracyHeld other = held({{"mesh", 0.01}, {source, 0.02}});
    EXPECT_FALSE(other.reached) << source;
    EXPECT_THAT(other.words, HasSubstr("with all parts of its bar asymptotic_wear_volume_m3 is known to 3 %"));
  }
  // A doubt that was to be left is none; what a history that decided leaves counts.
  EXPECT_FALSE(held({{"mesh", 0.01}, {"history", 0.02}}, false, 1, {{"mesh", 1e-3}}, false).reached);
  EXPECT_TRUE(held({{"mesh", 0.01}, {"history", 0.02}}, false).reached);
  EXPECT_FALSE(held({{"mesh", 0.01}, {"edge", 0.02}}, false).reached);
  EXPECT_FALSE(held({{"mesh", 0.01}, {"edge", 0.02}, {"history", 1}}, false).reached);
  EXPECT_TRUE(held({{"mesh", 0.01}, {"edge", 0.006}, {"history", 0.005}}, false).reached);
  EXPECT_FALSE(held({{"mesh", 0.01}, {"history", 1}}, false, 1, {{"mesh", 0.01}, {"edge", 0.02}}).reached);
}

TEST(AccuracyHeld, NamesWhatIsHeldToNone) {
  EXPECT_THAT(held({{"mesh", 0.01}}).words, Not(HasSubstr("held to none")));
  EXPECT_THAT(held({{"mesh", 0.01}}, true, 0).words, HasSubstr("held to none: contact_pressure_mean_pa"));
}

// What a search asks of one response is no excuse to hand it over less accurately than all others; where the search
// asks for nothing it was said of what is handed over.
TEST(AccuracyHeld, OfWhatIsHandedOverIsNoCoarserForOneResponseThanForAll) {
  Study study;
  study.optimizer.verify_accuracy = 0.02;
  study.problem.objective = {{.response = kVolume, .accuracy = 0.05}};
  study.problem.constraints = {{.response = kPressure, .lower = {}, .upper = 1e9, .accuracy = 0.01}};
  EXPECT_EQ(goal_at_best(study)->asked(kVolume), 0.05);
  study.scene.solver.accuracy = 0.1;
  EXPECT_EQ(goal_at_best(study)->asked(kVolume), 0.02);
  EXPECT_EQ(goal_at_best(study)->asked(kPressure), 0.01);
}

}  // namespace
}  // namespace dovetail::studies
