// What several rounds say of each other's bars, and what they foresee, against laws that are known.
#include <gtest/gtest.h>

#include <cmath>

#include "optimizer/accuracy/choice.hpp"
#include "optimizer/responses/response_table.hpp"
#include "tests/verification/optimizer/accuracy_laws.hpp"

namespace dovetail::optimizer {
namespace {

// A round whose bars are out of line, above those of coarser settings, is no reason to give up, nor to expect bars that
// do not fall.
TEST(Rounds, OneRoundOutOfLineIsNotTheLastWord) {
  for (const int wrong : {2, 3, 4}) {
    const Laws laws{.mesh = 0.1, .harmonics = 0.05};
    Laws off = laws;
    off.mesh *= 4;
    int calls = 0;
    const SettingsChoice choice =
        choose_settings(Scene{}, kGoal, [&](const Settings& s) { return (++calls == wrong ? off : laws).probe()(s); });
    EXPECT_EQ(choice.status, Status::converged) << wrong;
    EXPECT_LE(laws.sum(choice.settings), kGoal.relative) << wrong;
  }
}

/// Without what a history would settle.
double bar_of(const Evaluation& evaluation) {
  double sum = 0;
  for (const auto& [source, part] : evaluation.error_sources.at(kVolume))
    if (source != "history") sum += part;
  return sum;
}

// Small bars far apart contradict each other: both reach to where the other begins.
TEST(Rounds, BarsThatDoNotMeetAreRaised) {
  const Laws laws{.mesh = 0.05, .harmonics = 0.05};
  std::vector<Evaluation> answers;
  const SettingsChoice choice = choose_settings(Scene{}, kGoal, [&](const Settings& s) {
    AccuracyAnswer answer = laws.probe()(s);
    answer.evaluation.responses[kVolume] += 0.5 * static_cast<double>(answers.size());
    answers.push_back(answer.evaluation);
    return answer;
  });
  EXPECT_EQ(choice.status, Status::iteration_limit);
  ASSERT_TRUE(choice.tried.by);
  ASSERT_EQ(choice.raised.count(kVolume), 1U);
  const double value = choice.evaluation.responses.at(kVolume);
  EXPECT_NEAR(choice.tried.by->relative * value, bar_of(choice.evaluation), 1e-12);
  double furthest = 0;
  for (const Evaluation& answer : answers)
    furthest = std::max(furthest, std::abs(value - answer.responses.at(kVolume)) - bar_of(answer));
  EXPECT_NEAR(bar_of(choice.evaluation), furthest, 1e-12);
  for (const SettingsTried& round : choice.rounds) {
    if (round.settings == choice.settings) {
      EXPECT_EQ(round.excess, choice.tried.excess);
    }
  }
  // Another evaluation at those settings hears of it, too.
  Evaluation again = choice.evaluation;
  again.error_sources[kVolume] = laws.at(choice.settings);
  again.error_estimates[kVolume] = bar_of(again);
  raise_bars(choice.raised, again);
  EXPECT_NEAR(again.error_estimates.at(kVolume), bar_of(choice.evaluation), 1e-12);
  EXPECT_NEAR(bar_of(again), bar_of(choice.evaluation), 1e-12);
}

// One round that contradicts most of the others is not heard.
TEST(Rounds, ARoundThatContradictsTheOthersIsLeftOut) {
  for (const double off : {0.1, 0.2, 0.4})
    for (const int wrong : {1, 2, 3, 4}) {
      const Laws laws{.mesh = 0.05, .harmonics = 0.05};
      int calls = 0;
      const SettingsChoice choice = choose_settings(Scene{}, kGoal, [&](const Settings& s) {
        AccuracyAnswer answer = laws.probe()(s);
        if (++calls == wrong) answer.evaluation.responses[kVolume] += off;
        return answer;
      });
      EXPECT_EQ(choice.status, Status::converged) << off << " " << wrong;
      EXPECT_LE(std::abs(choice.evaluation.responses.at(kVolume) - 1), bar_of(choice.evaluation))
          << off << " " << wrong;
      EXPECT_LE(calls, 9) << off << " " << wrong;
    }
}

// A part is read from a difference that may be small by chance: it counts for the mean of itself and what the round
// before foresees, where that is more.
TEST(Rounds, APartThatIsSmallByChanceCountsForMore) {
  const Scene scene;
  const double order = find_response(kVolume)->mesh_order.in_plane;
  const Laws laws{.mesh = 0.1, .beside = 0, .by_mesh = order};
  Settings finer = settings_of(scene);
  finer.mesh = 1.333;
  for (const double chance : {1.0, 1e-2, 1e2}) {
    Laws there = laws;
    there.mesh *= chance;
    Forecast forecast(scene, kGoal);
    forecast.add(settings_of(scene), laws.probe()(settings_of(scene)).evaluation);
    forecast.add(finer, there.probe()(finer).evaluation);
    const BarParts raised = forecast.raised();
    const double own = there.at(finer).at("mesh");
    if (chance < 1) {
      ASSERT_EQ(raised.count(kVolume), 1U);
      const double expected = laws.at(finer).at("mesh");
      EXPECT_NEAR(raised.at(kVolume).at("mesh"), std::sqrt(own * expected), 1e-12);
      EXPECT_NEAR(kGoal.relative * forecast.excess(finer), there.sum(finer) - own + std::sqrt(own * expected), 1e-12);
    } else {
      EXPECT_NEAR(kGoal.relative * forecast.excess(finer), there.sum(finer), 1e-3 * own);
    }
  }
}

// Settings are taken where bars of what is asked are small, and so may be those of all else.
TEST(Rounds, BarsOfWhatIsNotAskedAreRaisedToo) {
  const Laws laws{.mesh = 0.05, .harmonics = 0.05};
  const std::string beside = "dissipated_energy_j";
  ASSERT_NE(find_response(beside), nullptr);
  int calls = 0;
  const SettingsChoice choice = choose_settings(Scene{}, kGoal, [&](const Settings& s) {
    AccuracyAnswer answer = laws.probe()(s);
    answer.evaluation.responses[beside] = 1 + 0.5 * calls++;
    answer.evaluation.error_sources[beside] = {{"mesh", 0.01}};
    answer.evaluation.error_estimates[beside] = 0.01;
    return answer;
  });
  ASSERT_EQ(choice.status, Status::converged);
  ASSERT_GT(choice.rounds.size(), 1U);
  EXPECT_GE(choice.evaluation.error_estimates.at(beside), 0.49);
  EXPECT_EQ(choice.evaluation.error_estimates.at(beside), choice.evaluation.error_sources.at(beside).at("mesh"));
}

// One round before that is out of line raises nothing.
TEST(Rounds, APartIsHeldToTheLesserOfWhatTwoRoundsExpect) {
  const Scene scene;
  const Laws laws{.mesh = 0.1, .beside = 0, .by_mesh = find_response(kVolume)->mesh_order.in_plane};
  Laws off = laws;
  off.mesh *= 10;
  Forecast forecast(scene, kGoal);
  Settings at = settings_of(scene);
  for (const Laws& round : {laws, off, laws}) {
    forecast.add(at, round.probe()(at).evaluation);
    EXPECT_TRUE(forecast.raised().empty()) << at.mesh;
    at.mesh *= 1.333;
  }
}

// A mesh beside the flanks that by one difference leaves nothing is not free to be coarser.
TEST(Rounds, NoPartOfTheMeshIsFree) {
  const Scene scene;
  const Laws laws{.mesh = 0.1, .beside = 0};
  const Settings at = settings_of(scene);
  for (const double leaves : {0.0, 1.0}) {
    Forecast forecast(scene, kGoal);
    forecast.add(at, laws.probe()(at).evaluation, {{kVolume, leaves}});
    Settings beside = at, along = at;
    beside.beside = along.mesh = 0.5;
    EXPECT_GT(forecast.excess(beside), 1.05 * forecast.excess(at));
    EXPECT_GT(forecast.excess(along), 1.05 * forecast.excess(at));
  }
}

}  // namespace
}  // namespace dovetail::optimizer
