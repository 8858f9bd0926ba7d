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
  return accuracy_held({}, optimizer::Scene(), goal, evaluation, asked_history);
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

// Settings are chosen of the first case; what counts may be of another one, or of all.
TEST(AccuracyHeld, OfEveryCaseThatCounts) {
  optimizer::Evaluation evaluation;
  evaluation.model = {{"dofs", 1e4}, {"contact_nodes", 20}, {"jacobians_spent", 9}, {"wear_history_may_differ", 0}};
  const auto in = [&](const std::string& name, double value, const Parts& parts) {
    evaluation.responses[name] = value;
    evaluation.error_sources[name] = parts;
  };
  in(kVolume, 1, {{"mesh", 0.01}});
  in(std::string(kVolume) + "@heavy", 1, {{"mesh", 0.01}});
  in(std::string(kVolume) + "@light", 0.01, {{"mesh", 0.005}, {"modes", 0.001}});
  const optimizer::AccuracyGoal goal{.relative = 0.02, .responses = {kVolume}};
  optimizer::Problem problem;
  problem.cases = {{.name = "heavy", .changes = {}}, {.name = "light", .changes = {}}};
  const auto over = [&](const char* rule) {
    problem.objective = {{.response = kVolume, .over = rule}};
    return accuracy_held(problem, optimizer::Scene(), goal, evaluation);
  };
  const AccuracyHeld light = over("light");
  EXPECT_FALSE(light.reached);
  EXPECT_THAT(light.words, HasSubstr("buy it in case heavy"));
  EXPECT_THAT(light.words, HasSubstr("asymptotic_wear_volume_m3@light is known to 60 % (asked: 2 %), most of it by "
                                     "mesh"));
  // What hardly adds to the whole may be known as badly as it likes.
  for (const char* rule : {"worst", "mean", "sum", "heavy"}) EXPECT_TRUE(over(rule).reached) << rule;
  EXPECT_THAT(over("worst").not_held, testing::IsEmpty());
  in(std::string(kVolume) + "@light", 0.9, {{"mesh", 0.2}});
  EXPECT_FALSE(over("worst").reached) << "it may be the worst";
  EXPECT_TRUE(over("heavy").reached);
  EXPECT_FALSE(over("deviation").reached);
  // What is not known in a case is not certified by another.
  evaluation.unbounded = {std::string(kVolume) + "@light"};
  EXPECT_THAT(over("light").not_held, testing::ElementsAre("asymptotic_wear_volume_m3@light"));
  EXPECT_THAT(over("worst").words, HasSubstr("held to none: asymptotic_wear_volume_m3"));
  EXPECT_THAT(over("heavy").not_held, testing::IsEmpty());
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
