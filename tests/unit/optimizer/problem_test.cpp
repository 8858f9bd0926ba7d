#include "optimizer/problem/problem.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "bowl.hpp"
#include "core/errors.hpp"

namespace dovetail::optimizer {
namespace {

Problem two_terms() {
  Problem problem = bowl_problem();
  problem.objective = {{.response = "asymptotic_wear_volume_m3", .weight = 2, .scale = 1e-10},
                       {.response = "resonance_drift", .weight = 1, .scale = 1e-3, .absolute = true}};
  problem.constraints = {{.response = "peak_amplitude_m", .lower = 2e-3, .upper = 8e-3},
                         {.response = "resonance_drift", .lower = {}, .upper = 0, .scale = 1e-3}};
  return problem;
}

Evaluation typical() {
  Evaluation e;
  e.responses = {{"asymptotic_wear_volume_m3", 3e-10}, {"resonance_drift", -5e-4}, {"peak_amplitude_m", 1e-2}};
  return e;
}

TEST(Problem, WeighsAndScalesTheTerms) {
  const Judgement judgement = judge(two_terms(), typical(), 0);
  EXPECT_TRUE(judgement.computed);
  EXPECT_DOUBLE_EQ(judgement.objective, 2 * 3 + 0.5);
}

TEST(Problem, NormalisesConstraints) {
  EXPECT_THAT(constraint_names(two_terms()),
              ::testing::ElementsAre("peak_amplitude_m:upper", "peak_amplitude_m:lower", "resonance_drift:upper"));
  const Judgement judgement = judge(two_terms(), typical(), 0);
  ASSERT_EQ(judgement.constraints.size(), 3U);
  EXPECT_DOUBLE_EQ(judgement.constraints[0], 0.25);
  EXPECT_DOUBLE_EQ(judgement.constraints[1], -4);
  EXPECT_DOUBLE_EQ(judgement.constraints[2], -0.5);
  EXPECT_FALSE(judgement.feasible);
  EXPECT_DOUBLE_EQ(judgement.violation, 0.25);
  EXPECT_TRUE(judge(two_terms(), typical(), 0.25).feasible);
}

TEST(Problem, JudgesRules) {
  Evaluation e = typical();
  e.responses["peak_amplitude_m"] = 5e-3;
  EXPECT_TRUE(judge(two_terms(), e, 0).feasible);
  e.constraints["rule:simple"] = 0;
  EXPECT_TRUE(judge(two_terms(), e, 0).feasible);
  EXPECT_FALSE(judge(two_terms(), e, 0).rules);
  e.constraints["rule:wall"] = -0.2;
  EXPECT_DOUBLE_EQ(judge(two_terms(), e, 0).rules.value(), -0.2);
  e.constraints["rule:cutter"] = 0.1;
  e.constraints["something else"] = 3;
  const Judgement judgement = judge(two_terms(), e, 0);
  EXPECT_FALSE(judgement.feasible);
  EXPECT_DOUBLE_EQ(judgement.rules.value(), 0.1);
  EXPECT_DOUBLE_EQ(judgement.violation, 0.1);
  EXPECT_DOUBLE_EQ(judge(two_terms(), broken(0.3), 0).violation, 0.3);
}

TEST(Problem, TakesAnInfeasibleCandidateWithoutRulesAsBroken) {
  Evaluation e;
  e.status = "infeasible";
  const Judgement judgement = judge(two_terms(), e, 0);
  EXPECT_FALSE(judgement.computed);
  EXPECT_TRUE(std::isnan(judgement.objective));
  EXPECT_DOUBLE_EQ(judgement.rules.value(), 1);
  EXPECT_DOUBLE_EQ(judgement.violation, 1);
}

TEST(Problem, AnnotatesConstraintsAndMissingValues) {
  Evaluation e = typical();
  annotate(two_terms(), 0, e);
  EXPECT_TRUE(e.converged());
  EXPECT_FALSE(e.feasible);
  EXPECT_DOUBLE_EQ(e.constraints.at("peak_amplitude_m:upper"), 0.25);
  e.responses["resonance_drift"] = std::nan("");
  annotate(two_terms(), 0, e);
  EXPECT_EQ(e.status, "response: resonance_drift is not finite");
  EXPECT_FALSE(e.feasible);
  Evaluation without = typical();
  without.responses.erase("peak_amplitude_m");
  annotate(two_terms(), 0, without);
  EXPECT_EQ(without.status, "response: peak_amplitude_m is missing");
  annotate(two_terms(), 0, without);
  EXPECT_EQ(without.status, "response: peak_amplitude_m is missing");
}

// Values decide what is feasible; what lies within its bar of the limit, on either side, is not decided.
TEST(Problem, NamesConstraintsWithinTheirBars) {
  Evaluation e = typical();
  e.responses["peak_amplitude_m"] = 7.9e-3;
  e.error_estimates = {{"peak_amplitude_m", 0.2e-3}, {"resonance_drift", 1e-4}};
  annotate(two_terms(), 0, e);
  EXPECT_TRUE(e.feasible);
  EXPECT_THAT(e.undecided_constraints, ::testing::ElementsAre("peak_amplitude_m:upper"));
  e.error_estimates["peak_amplitude_m"] = 0.05e-3;
  annotate(two_terms(), 0, e);
  EXPECT_TRUE(e.undecided_constraints.empty());
  e.error_estimates["resonance_drift"] = 6e-4;
  annotate(two_terms(), 0, e);
  EXPECT_THAT(e.undecided_constraints, ::testing::ElementsAre("resonance_drift:upper"));
  // No limit is decided by a response that has no bar.
  e.error_estimates.erase("resonance_drift");
  e.unbounded = {"resonance_drift"};
  annotate(two_terms(), 0, e);
  EXPECT_THAT(e.undecided_constraints, ::testing::ElementsAre("resonance_drift:upper"));
}

TEST(Problem, SuggestsTheNearestResponse) {
  Problem problem = two_terms();
  problem.objective[0].response = "asymptotic_wear_volume";
  try {
    require_responses(problem, typical());
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("did you mean asymptotic_wear_volume_m3?"));
  }
  EXPECT_NO_THROW(require_responses(two_terms(), typical()));
}

TEST(Problem, ReportsEverythingWrong) {
  Problem problem = two_terms();
  problem.objective[0].scale = 0;  // two terms need scales
  problem.objective[1].weight = 0;
  problem.constraints[0].lower = 9e-3;  // above upper
  problem.constraints[1].scale = 0;     // limit 0
  problem.constraints.push_back({.response = "mass_kg", .lower = {}, .upper = {}});
  try {
    check(problem);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.violations().size(), 5U) << error.what();
  }
  EXPECT_NO_THROW(check(two_terms()));
}

TEST(Problem, NamesEachResponseOnce) {
  Problem problem;
  for (const char* name : {"a", "b", "b"}) problem.objective.emplace_back().response = name;
  for (const char* name : {"b", "c", "a"}) problem.constraints.emplace_back().response = name;
  EXPECT_EQ(responses_of(problem), (std::vector<std::string>{"a", "b", "c"}));
}

/// Two cases, the second four times as long; wear of 1 and 3, an amplitude of 5 and 2.
Problem with_cases() {
  Problem problem = bowl_problem();
  problem.objective = {{.response = "wear"}};
  problem.constraints = {{.response = "amplitude", .lower = 1, .upper = 4}};
  problem.cases = {{.name = "cruise", .weight = 1, .changes = {}}, {.name = "climb", .weight = 4, .changes = {}}};
  return problem;
}

Evaluation in_both() {
  Evaluation e;
  e.responses = {{"wear", 1},       {"amplitude", 5},      {"wear@cruise", 1}, {"amplitude@cruise", 5},
                 {"wear@climb", 3}, {"amplitude@climb", 2}};
  e.error_estimates = {{"wear@cruise", 2.5}, {"wear@climb", 0.25}, {"amplitude@cruise", 0.5}, {"amplitude@climb", 2}};
  return e;
}

double objective_over(const char* over) {
  Problem problem = with_cases();
  problem.objective[0].over = over;
  return judge(problem, in_both(), 0).objective;
}

TEST(ProblemWithCases, CountsThemAsTheTermSays) {
  EXPECT_DOUBLE_EQ(objective_over("worst"), 3);
  EXPECT_DOUBLE_EQ(objective_over("mean"), (1 + 4 * 3) / 5.0);
  EXPECT_DOUBLE_EQ(objective_over("sum"), 13);
  EXPECT_DOUBLE_EQ(objective_over("cruise"), 1);
  // What is to be large is worst where it is smallest, what has an aim where it is farthest from it.
  Problem problem = with_cases();
  problem.objective[0].weight = -1;
  EXPECT_DOUBLE_EQ(judge(problem, in_both(), 0).objective, -1);
  problem.objective = {{.response = "wear", .weight = 2, .scale = 4, .absolute = true, .target = 2.5}};
  EXPECT_DOUBLE_EQ(judge(problem, in_both(), 0).objective, 2 * 1.5 / 4);
}

// How far they scatter is no smaller where what scatters is to be large.
TEST(ProblemWithCases, DeviationsHaveTheSameSenseOnBothSides) {
  Problem problem = with_cases();
  problem.objective = {{.response = "wear", .weight = -2, .scale = 4, .over = "deviation"}};
  const double deviation = std::sqrt((1 * 1.6 * 1.6 + 4 * 0.4 * 0.4) / 5);
  EXPECT_DOUBLE_EQ(judge(problem, in_both(), 0).objective, -2 * deviation / 4);
  const Barred told =
      as_response(problem.objective[0], term_value(problem, problem.objective[0], in_both().responses, {}));
  EXPECT_DOUBLE_EQ(told.value, deviation);
  problem.constraints = {{.response = "wear", .lower = 0.5, .upper = 1, .over = "deviation"}};
  const Judgement judgement = judge(problem, in_both(), 0);
  EXPECT_DOUBLE_EQ(judgement.constraints[0], deviation - 1);
  EXPECT_DOUBLE_EQ(judgement.constraints[1], (0.5 - deviation) / 0.5);
  EXPECT_TRUE(judgement.feasible);
}

TEST(ProblemWithCases, KeepsLimitsInEachOfThem) {
  Problem problem = with_cases();
  Judgement judgement = judge(problem, in_both(), 0);
  EXPECT_DOUBLE_EQ(judgement.constraints[0], (5 - 4) / 4.0);  // upper, in the one case
  EXPECT_DOUBLE_EQ(judgement.constraints[1], 1 - 2);          // lower, in the other
  EXPECT_FALSE(judgement.feasible);
  problem.constraints[0].over = "climb";
  EXPECT_TRUE(judge(problem, in_both(), 0).feasible);
  EXPECT_THAT(constraint_names(problem), testing::ElementsAre("amplitude@climb:upper", "amplitude@climb:lower"));
  problem.constraints[0] = {.response = "amplitude", .lower = {}, .upper = 10, .over = "sum"};
  EXPECT_DOUBLE_EQ(judge(problem, in_both(), 0).constraints[0], (5 + 4 * 2 - 10) / 10.0);
}

// In the response's unit; a deviation is known as well as its bar is small beside the mean.
TEST(ProblemWithCases, TellsWhatObjectiveAndLimitsSee) {
  Problem problem = with_cases();
  problem.objective = {{.response = "wear", .weight = 2, .scale = 4, .over = "climb"},
                       {.response = "wear", .over = "deviation"}};
  const Evaluation e = in_both();
  const std::vector<CaseNumber> numbers = numbers_asked(problem, e.responses, e.error_estimates);
  ASSERT_EQ(numbers.size(), 4U);
  EXPECT_EQ(numbers[0].name, "wear@climb");
  EXPECT_EQ(numbers[0].response, "wear");
  EXPECT_DOUBLE_EQ(numbers[0].number.value, 3);
  EXPECT_DOUBLE_EQ(numbers[0].number.bar, 0.25);
  EXPECT_DOUBLE_EQ(numbers[0].size, 3);
  EXPECT_EQ(numbers[1].name, "wear@deviation");
  EXPECT_DOUBLE_EQ(numbers[1].size, (1 + 4 * 3) / 5.0);
  EXPECT_EQ(numbers[2].name, "amplitude");  // upper limit: the larger one
  EXPECT_DOUBLE_EQ(numbers[2].number.value, 5);
  EXPECT_DOUBLE_EQ(numbers[3].number.value, 2);
  EXPECT_DOUBLE_EQ(numbers[3].number.bar, 2);
}

// By size the lower of two negative numbers is the worst one, and the farther from a target.
TEST(ProblemWithCases, TellsWhatCountsByItsSize) {
  Problem problem = with_cases();
  Evaluation e = in_both();
  for (const auto& [load_case, value, bar] : {std::tuple{"cruise", -1.0, 0.5}, std::tuple{"climb", -8.0, 0.25}}) {
    e.responses[of_case("drift", load_case)] = value;
    e.error_estimates[of_case("drift", load_case)] = bar;
  }
  problem.objective = {{.response = "drift", .absolute = true}, {.response = "drift", .absolute = true, .target = -9}};
  problem.constraints = {{.response = "drift", .lower = {}, .upper = 10, .absolute = true}};
  const std::vector<CaseNumber> numbers = numbers_asked(problem, e.responses, e.error_estimates);
  ASSERT_EQ(numbers.size(), 3U);
  for (const CaseNumber& number : {numbers[0], numbers[2]}) {
    EXPECT_DOUBLE_EQ(number.number.value, 8);
    EXPECT_DOUBLE_EQ(number.number.bar, 0.25);
    EXPECT_DOUBLE_EQ(number.size, 8);
  }
  EXPECT_DOUBLE_EQ(numbers[1].number.value, 8);  // of cruise, at a distance of 8 from -9
  EXPECT_DOUBLE_EQ(numbers[1].number.bar, 0.5);
  EXPECT_DOUBLE_EQ(numbers[1].size, 8);
}

// The worst case may be another one within the bars.
TEST(ProblemWithCases, BarsOfTheWorstHoldWhicheverItIs) {
  Problem problem = with_cases();
  const Evaluation e = in_both();
  EXPECT_DOUBLE_EQ(judgement_bars(problem, e.responses, e.error_estimates).objective, 0.5);  // 1 + 2.5 against 3
  EXPECT_DOUBLE_EQ(judgement_bars(problem, e.responses, e.error_estimates).constraints[0], 0.5 / 4);
  problem.objective[0].over = "mean";
  EXPECT_DOUBLE_EQ(judgement_bars(problem, e.responses, e.error_estimates).objective, (2.5 + 4 * 0.25) / 5);
  problem.objective[0].over = "climb";
  EXPECT_DOUBLE_EQ(judgement_bars(problem, e.responses, e.error_estimates).objective, 0.25);
}

TEST(ProblemWithCases, AResponseMissingInOneIsAFailure) {
  Evaluation e = in_both();
  e.responses.erase("wear@climb");
  EXPECT_FALSE(judge(with_cases(), e, 0).computed);
  annotate(with_cases(), 0, e);
  EXPECT_EQ(e.status, "response: wear@climb is missing");
}

// Of designs that do not wear the one farthest from slip is the best, and then the one that moves least.
TEST(BetterDesigns, AreFartherFromSlipWhereObjectivesAreTheSame) {
  Problem problem;
  problem.objective = {{.response = "worn"}};
  const auto judged = [&](double worn, double margin, double amplitude) {
    Evaluation e;
    e.responses = {{"worn", worn}, {"peak_amplitude_m", amplitude}};
    if (margin >= 0) e.model[kSlipMargin] = margin;
    return judge(problem, e, 0);
  };
  EXPECT_TRUE(better(judged(1, -1, 9), judged(2, 0.9, 1)));
  EXPECT_TRUE(better(judged(0, 0.3, 9), judged(0, 0.2, 1)));
  EXPECT_TRUE(better(judged(0, 0, 9), judged(0, -1, 1)));
  EXPECT_TRUE(better(judged(0, 0.3, 1), judged(0, 0.3, 2)));
  EXPECT_FALSE(better(judged(0, 0.3, 1), judged(0, 0.3, 1)));
  // Next to nothing is not nothing.
  EXPECT_TRUE(better(judged(0, 0.1, 1), judged(1e-30, -1, 1)));
}

TEST(BetterDesigns, HaveTheMarginOfTheirWorstCase) {
  Problem problem;
  problem.objective = {{.response = "worn"}};
  problem.cases = {{.name = "a", .changes = {}}, {.name = "b", .changes = {}}};
  Evaluation e;
  e.responses = {{"worn@a", 0}, {"worn@b", 0}, {"peak_amplitude_m@a", 1}, {"peak_amplitude_m@b", 3}};
  e.model = {{"slip_margin@a", 0.4}, {"slip_margin@b", 0.2}, {"slip_margin", 0.4}};
  EXPECT_EQ(judge(problem, e, 0).slip_margin, 0.2);
  EXPECT_EQ(judge(problem, e, 0).amplitude, 3);
  e.model.erase("slip_margin@b");  // it wears there
  EXPECT_LT(judge(problem, e, 0).slip_margin, 0);
}

}  // namespace
}  // namespace dovetail::optimizer
