// Settings chosen for an accuracy: against laws that are known, and against a finer model.
#include "optimizer/accuracy/choice.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "optimizer/responses/response_table.hpp"
#include "optimizer/scene/scene_kind.hpp"
#include "quality/truncation.hpp"
#include "tests/verification/optimizer/accuracy_laws.hpp"
#include "tests/verification/optimizer/coarse_scene.hpp"

namespace dovetail::optimizer {
namespace {

TEST(Accuracy, IsReachedAtHardlyMoreThanTheLeastCost) {
  const Scene scene;
  for (const Laws& laws : {Laws{}, Laws{.mesh = 0.002}, Laws{.harmonics = 0.2}, Laws{.samples = 0.1, .by_samples = 1.3},
                           Laws{.mesh = 0.1, .by_mesh = 1.2}, Laws{.beside = 0.03}}) {
    int calls = 0;
    const SettingsChoice choice = choose_settings(scene, kGoal, laws.probe(&calls));
    ASSERT_EQ(choice.status, Status::converged);
    EXPECT_LE(laws.sum(choice.settings), kGoal.relative);
    EXPECT_LE(calls, 8);
    // Of all that keep a little distance from what is asked.
    double least = kInfinity, own = 0;
    for (const Settings& settings : all_settings(scene, {}, 0.02))
      if (laws.sum(settings) <= 0.95 * kGoal.relative) least = std::min(least, operations(settings));
    own = operations(choice.settings);
    EXPECT_LE(own, 1.5 * least) << choice.settings.mesh << " " << choice.settings.beside << " "
                                << choice.settings.harmonics << " " << choice.settings.samples << " "
                                << choice.settings.modes;
  }
}

// Of a peak that is narrow, or whose width nothing is known of, the height is kept.
TEST(Accuracy, KeepsTheToleranceOfAResonanceBelowItsWidth) {
  Scene scene;
  scene.loading.damping_ratio = 1e-5;
  const Laws laws{.search = 1e-12};
  EXPECT_EQ(choose_settings(scene, kGoal, laws.probe()).settings.resonance_tolerance, 1e-7);
  scene.loading.damping_ratio = 0;
  EXPECT_EQ(choose_settings(scene, kGoal, laws.probe()).settings.resonance_tolerance, 1e-7);
  scene.loading.damping_ratio = 1e-3;
  EXPECT_EQ(choose_settings(scene, kGoal, laws.probe()).settings.resonance_tolerance, 1e-5);
  AccuracyGoal goal = kGoal;
  goal.fixed = {"solver.resonance_tolerance"};
  EXPECT_EQ(choose_settings(scene, goal, laws.probe()).settings.resonance_tolerance, 1e-7);
}

TEST(Accuracy, LeavesWhatIsGivenAsItIs) {
  const Scene scene;
  AccuracyGoal goal = kGoal;
  goal.fixed = {"mesh.bulk_size_mm", "solver.samples"};
  const SettingsChoice choice = choose_settings(scene, goal, Laws{.mesh = 0.005}.probe());
  EXPECT_EQ(choice.status, Status::converged);
  EXPECT_EQ(choice.settings.beside, 1);
  EXPECT_EQ(choice.settings.samples, scene.solver.samples);
  EXPECT_GT(choice.settings.harmonics, scene.solver.harmonics);
  goal.fixed = {"mesh.flank_elements"};
  const SettingsChoice along = choose_settings(scene, goal, Laws{.mesh = 0.005, .beside = 0.02}.probe());
  EXPECT_EQ(along.status, Status::converged);
  EXPECT_EQ(along.settings.mesh, 1);
  EXPECT_GT(along.settings.beside, 1);
}

// A mesh that leaves fifteen times what is asked for is nothing that harmonics and samples could mend.
TEST(Accuracy, OfTruncationAloneCountsNothingElse) {
  const Scene scene;
  AccuracyGoal goal = kGoal;
  goal.of_truncation = true;
  for (const auto& [key, value] : settings_by_key(scene, settings_of(scene)))
    if (key != "solver.harmonics" && key != "solver.samples") goal.fixed.insert(key);
  const Laws laws{.mesh = 0.3};
  const SettingsChoice choice = choose_settings(scene, goal, laws.probe());
  ASSERT_EQ(choice.status, Status::converged);
  const auto bars = laws.at(choice.settings);
  EXPECT_LE(bars.at("harmonics") + bars.at("samples"), goal.relative);
  EXPECT_GT(choice.settings.harmonics, scene.solver.harmonics);
  Settings others = choice.settings;
  others.harmonics = scene.solver.harmonics;
  others.samples = scene.solver.samples;
  EXPECT_EQ(others, settings_of(scene));
  goal.of_truncation = false;
  EXPECT_EQ(choose_settings(scene, goal, laws.probe()).status, Status::iteration_limit);
}

TEST(Accuracy, OfTruncationAloneAsksTheOwnMesh) {
  const Scene scene = coarse_scene();
  const SceneEvaluator evaluator(scene);
  const Evaluation alone =
      evaluator.evaluate(scene, {.truncation_alone = true, .history = false, .until = Stage::unworn}).evaluation;
  ASSERT_TRUE(alone.converged()) << alone.status;
  Scene finer = scene;
  finer.solver.samples *= 2;
  const Evaluation of_samples =
      evaluator.evaluate(finer, {.bars = false, .history = false, .until = Stage::unworn}).evaluation;
  const auto& sources = alone.error_sources.at("dissipated_energy_j");
  EXPECT_EQ(sources.size(), 3U);
  const double change =
      std::abs(of_samples.responses.at("dissipated_energy_j") - alone.responses.at("dissipated_energy_j"));
  // The companion begins with the contact nodes of the design, this one with none: they end a little beside each other.
  EXPECT_NEAR(sources.at("samples"), quality::truncation_factors(true).samples * change, 0.1 * change);
  EXPECT_EQ(sources.count("mesh"), 0U);
}

constexpr const char* kPeak = "contact_pressure_max_pa";

/// Flanks whose rounded ends have a pressure peak that a fine mesh resolves.
Scene rounded_ends() {
  Scene scene;
  scene.geometry.flank("left").edge_radius = scene.geometry.flank("right").edge_radius = 0.02;
  return scene;
}

/// The volume by these laws, and a peak that so many times the edges resolve.
AccuracyProbe with_peak(const Laws& laws, double resolves) {
  return [laws, resolves](const Settings& s) {
    AccuracyAnswer answer = laws.probe()(s);
    Evaluation& evaluation = answer.evaluation;
    const double bar = *find_response(kPeak)->largest_bar * std::pow(s.mesh / resolves, -2.0);
    evaluation.responses[kPeak] = 1;
    evaluation.error_sources[kPeak] = {{"mesh", bar}};
    if (s.mesh < resolves)
      evaluation.unbounded = {kPeak};
    else
      evaluation.error_estimates[kPeak] = bar;
    return answer;
  };
}

// A response that a mesh does not resolve has no bar there; asked for by name, it is looked for on a finer one.
TEST(Accuracy, AnUnresolvedResponseAsksForAFinerMesh) {
  const Scene scene = rounded_ends();
  ASSERT_TRUE(find_response(kPeak)->has_limit(scene));
  AccuracyGoal goal{.relative = 0.05, .responses = {kPeak}};
  const AccuracyProbe probe = with_peak({}, 1.4);
  const SettingsChoice choice = choose_settings(scene, goal, probe);
  EXPECT_EQ(choice.status, Status::converged);
  EXPECT_TRUE(choice.not_held.empty());
  EXPECT_FALSE(std::isfinite(choice.rounds.front().by->relative));
  EXPECT_GT(choice.settings.mesh, 3);
  // However little is asked, what has no bar does not do.
  goal.relative = 0.6;
  EXPECT_GE(choose_settings(scene, goal, probe).settings.mesh, 1.4);
  goal.relative = 0.05;
  // Where nothing is named it is left out, as it always was.
  goal.responses.clear();
  EXPECT_LT(choose_settings(scene, goal, probe).settings.mesh, 2);
}

TEST(Accuracy, WhatTheFinestMeshAloneResolvesIsFoundThere) {
  const AccuracyGoal goal{.relative = 0.5, .responses = {kPeak}};
  const SettingsChoice choice = choose_settings(rounded_ends(), goal, with_peak({}, 5));
  EXPECT_EQ(choice.status, Status::converged);
  EXPECT_GT(choice.settings.mesh, 5);
}

// The others are held to what is asked; of one alone nothing says what other settings would do.
TEST(Accuracy, WhereNoMeshResolvesOneTheOthersCount) {
  const Scene scene = rounded_ends();
  constexpr double kNever = 100;
  for (const bool fixed : {true, false}) {
    AccuracyGoal goal{.relative = 0.02, .responses = {kVolume, kPeak}};
    if (fixed) goal.fixed = {"mesh.flank_elements"};
    const Laws laws{.mesh = 0.005};
    const SettingsChoice choice = choose_settings(scene, goal, with_peak(laws, kNever));
    EXPECT_EQ(choice.status, Status::iteration_limit);
    EXPECT_EQ(choice.tried.by->response, kPeak);
    EXPECT_LE(laws.sum(choice.settings), goal.relative) << fixed;
    EXPECT_LT(choice.settings.mesh, 3);  // the finest tried is more than twice as fine
    const SettingsChoice alone =
        choose_settings(scene, {.relative = 0.02, .responses = {kPeak}, .fixed = goal.fixed}, with_peak(laws, kNever));
    EXPECT_EQ(alone.status, Status::iteration_limit);
    Settings own = settings_of(scene);
    own.history_tolerance = alone.settings.history_tolerance;
    EXPECT_EQ(alone.settings, own);
  }
}

// Where the search looks on for cheaper settings it stays on meshes that resolve all that is asked of.
TEST(Accuracy, CheaperSettingsAreOnMeshesThatResolve) {
  AccuracyGoal goal{.relative = 0.3, .responses = {kVolume, kPeak}};
  const SettingsChoice choice = choose_settings(rounded_ends(), goal, with_peak({}, 1.8));
  EXPECT_EQ(choice.status, Status::converged);
  bool resolved = false;
  for (const SettingsTried& round : choice.rounds) {
    EXPECT_GT(round.settings.mesh, resolved ? 1.34 : 0) << "known not to";
    resolved = resolved || round.settings.mesh >= 1.8;
  }
  EXPECT_TRUE(resolved);
}

TEST(Accuracy, OutOfReachIsSaid) {
  const Scene scene;
  AccuracyGoal goal = kGoal;
  goal.fixed = {"mesh.flank_elements"};
  const SettingsChoice choice = choose_settings(scene, goal, Laws{.mesh = 0.03}.probe());
  EXPECT_EQ(choice.status, Status::iteration_limit);
  ASSERT_TRUE(choice.tried.by);
  EXPECT_EQ(choice.tried.by->source, "mesh");
  EXPECT_GT(choice.tried.by->relative, goal.relative);
  // Nothing much better was tried.
  for (const SettingsTried& tried : choice.rounds) EXPECT_GE(1.25 * tried.excess, choice.tried.excess);
}

// Bars that hardly fall: after two rounds no more is spent on finer meshes, nor on the one that was tried.
TEST(Accuracy, OutOfReachOfEverySettingCostsTwoRounds) {
  const Laws laws{.mesh = 0.08, .harmonics = 1e-3, .samples = 3e-4, .modes = 2e-4, .by_mesh = 0.3};
  int calls = 0;
  const SettingsChoice choice = choose_settings(Scene{}, kGoal, laws.probe(&calls));
  EXPECT_EQ(choice.status, Status::iteration_limit);
  EXPECT_EQ(calls, 2);
  ASSERT_TRUE(choice.out_of_reach);
  EXPECT_GT(*choice.out_of_reach, 1);
  ASSERT_EQ(choice.rounds.size(), 2U);
  EXPECT_LT(choice.rounds[1].excess, choice.rounds[0].excess);
  EXPECT_LE(choice.tried.operations, choice.rounds[0].operations);
  EXPECT_FALSE(choose_settings(Scene{}, kGoal, Laws{}.probe()).out_of_reach);
}

// Bars that scatter, larger on finer settings: rounds that bring nothing end it, long before the last.
TEST(Accuracy, RoundsThatBringNothingEndIt) {
  const Laws laws{.mesh = 0.05, .harmonics = 0.05};
  int calls = 0;
  const SettingsChoice choice = choose_settings(Scene{}, kGoal, [&](const Settings& s) {
    AccuracyAnswer answer = laws.probe()(s);
    constexpr std::array kScatter{1.0, 0.5, 0.3, 0.6, 0.45, 0.7, 0.4, 0.8, 0.5, 0.6};
    const double scale = kScatter.at(static_cast<std::size_t>(calls++));
    const double sum = laws.sum(s);
    for (auto& [source, bar] : answer.evaluation.error_sources[kVolume])
      bar *= scale * laws.sum(settings_of(Scene{})) / sum;
    return answer;
  });
  EXPECT_LE(calls, 6);
  EXPECT_TRUE(choice.ran_idle);
  EXPECT_EQ(choice.status, Status::iteration_limit);
  EXPECT_FALSE(choose_settings(Scene{}, kGoal, Laws{}.probe()).ran_idle);
}

// Bars that fall by less than they promise: the work of the rounds is limited, and what they found stays.
TEST(Accuracy, TheWorkOfAChoiceIsLimited) {
  const Laws laws{.mesh = 0.05, .harmonics = 0.05};
  // Each round leaves a third less than the one before, whatever it was asked for.
  const auto choose = [&](double work) {
    Scene scene;
    scene.solver.accuracy_work = work;
    double scale = 1;
    return choose_settings(scene, kGoal, [&](const Settings& s) {
      AccuracyAnswer answer = laws.probe()(s);
      scale *= 0.65;
      const double sum = laws.sum(s);
      for (auto& [source, bar] : answer.evaluation.error_sources[kVolume])
        bar *= scale * laws.sum(settings_of(Scene{})) / sum;
      return answer;
    });
  };
  const auto spent = [](const SettingsChoice& choice) {
    double sum = 0;
    for (const SettingsTried& round : choice.rounds) sum += round.operations;
    return sum / choice.rounds.front().operations;
  };
  const SettingsChoice all = choose(0), some = choose(4);
  EXPECT_NE(all.status, Status::budget_spent);
  EXPECT_GT(spent(all), 4);
  EXPECT_EQ(some.status, Status::budget_spent);
  EXPECT_LE(spent(some), 4);
  EXPECT_GT(some.rounds.size(), 1U);
  EXPECT_LT(some.rounds.size(), all.rounds.size());
  ASSERT_TRUE(some.tried.by);
  EXPECT_EQ(some.evaluation.responses.count(kVolume), 1U);
}

// What one evaluation would save by settings that are cheaper still pays for no round.
TEST(Accuracy, OfOneEvaluationIsThatOfTheFirstSettingsThatWillDo) {
  AccuracyGoal goal = kGoal;
  goal.many = false;
  for (const Laws& laws : {Laws{.mesh = 1e-4, .harmonics = 1e-4, .samples = 1e-4, .modes = 1e-4}, Laws{.mesh = 0.1}}) {
    int calls = 0;
    const SettingsChoice choice = choose_settings(Scene{}, goal, laws.probe(&calls));
    ASSERT_EQ(choice.status, Status::converged);
    EXPECT_TRUE(choice.settings == choice.rounds.back().settings);
    EXPECT_EQ(calls == 1, laws.sum(settings_of(Scene{})) <= goal.relative);
    for (std::size_t i = 0; i + 1 < choice.rounds.size(); ++i) EXPECT_GT(choice.rounds[i].excess, 1);
    int more = 0;
    EXPECT_LE(choose_settings(Scene{}, kGoal, laws.probe(&more)).tried.operations, choice.tried.operations);
    EXPECT_LE(calls, more);
  }
}

// One digit more is ten times the accuracy of histories, too, and its price is about what it takes.
TEST(Accuracy, OneMoreDigitIsOneOfHistoriesAtItsPrice) {
  const Laws laws{.mesh = 2e-3, .harmonics = 2e-3, .samples = 1e-3};
  const SettingsChoice choice = choose_settings(Scene{}, kGoal, laws.probe());
  ASSERT_TRUE(choice.one_more_digit);
  const Settings& there = choice.one_more_digit->settings;
  const double times = operations(there) / operations(choice.settings);
  EXPECT_LT(choice.one_more_digit->times_as_long, 2 * times);
  EXPECT_GT(choice.one_more_digit->times_as_long, times / 2);
  EXPECT_NEAR(choice.settings.history_tolerance, 2e-3, 1e-12);
  EXPECT_NEAR(choice.one_more_digit->settings.history_tolerance, 2e-4, 1e-12);
}

TEST(Accuracy, EndsWhenToldTo) {
  int calls = 0;
  const SettingsChoice choice = choose_settings(Scene{}, {.relative = 3e-3, .responses = {kVolume}},
                                                Laws{}.probe(&calls), [&](const SettingsTried&) { return calls < 2; });
  EXPECT_EQ(calls, 2);
  EXPECT_EQ(choice.rounds.size(), 2U);
  EXPECT_FALSE(choice.out_of_reach);
  EXPECT_EQ(choice.status, Status::iteration_limit);
}

TEST(Accuracy, WhatNoSettingBuysIsLeftOut) {
  const SettingsChoice choice = choose_settings(Scene{}, kGoal, Laws{.history = 10}.probe());
  EXPECT_EQ(choice.status, Status::converged);
}

// Of a response without a value, or without a bar, no settings are known to be accurate enough.
TEST(Accuracy, IsNotReachedWhereNothingIsHeldToIt) {
  const SettingsChoice none = choose_settings(Scene{}, kGoal, [](const Settings& s) {
    Evaluation evaluation = Laws{}.probe()(s).evaluation;
    evaluation.responses[kVolume] = 0;
    return evaluation;
  });
  EXPECT_EQ(none.status, Status::stalled);
  EXPECT_TRUE(none.settings == settings_of(Scene{}));
  EXPECT_EQ(none.rounds.size(), 1U);
  EXPECT_EQ(none.not_held, std::vector<std::string>{kVolume});
  // Others are held all the same, and it is said which are not.
  AccuracyGoal goal = kGoal;
  goal.responses.emplace_back("peak_amplitude_m");
  const SettingsChoice one = choose_settings(Scene{}, goal, Laws{}.probe());
  EXPECT_EQ(one.status, Status::converged);
  EXPECT_EQ(one.not_held, std::vector<std::string>{"peak_amplitude_m"});
}

// So few samples that every number of harmonics on the ladder would alias.
TEST(Accuracy, HasNothingToChooseWhereSamplesAreTooFew) {
  Scene scene;
  scene.solver.samples = 12;
  AccuracyGoal goal = kGoal;
  goal.fixed = {"solver.samples"};
  const SettingsChoice choice = choose_settings(scene, goal, Laws{}.probe());
  EXPECT_TRUE(choice.settings == settings_of(scene));
  EXPECT_EQ(choice.status, Status::iteration_limit);
}

// A file's samples that are too few for its harmonics change, or these do: mesh and modes are its own at first.
TEST(Accuracy, BeginsBesideTheOwnSettings) {
  Scene scene;
  scene.solver.harmonics = 15;
  const Settings own = settings_of(scene);
  const Settings first = choose_settings(scene, kGoal, Laws{}.probe()).rounds.front().settings;
  EXPECT_EQ(first.mesh, own.mesh);
  EXPECT_EQ(first.beside, own.beside);
  EXPECT_EQ(first.modes, own.modes);
  EXPECT_GE(first.samples, 8 * (2 * first.harmonics + 1));
}

// In space the own mesh may cost as much as all coarser ones together, but where those have no answer it is asked.
TEST(Accuracy, BeginsOnTheCoarsestMeshInSpace) {
  Scene scene;
  scene.kind = &kSector;
  const AccuracyProbe probe = Laws{}.probe();
  const SettingsChoice choice = choose_settings(scene, kGoal, probe);
  const double coarsest = all_settings(scene, {}, 0.02).front().mesh;
  EXPECT_LT(coarsest, 1);
  EXPECT_EQ(choice.rounds.front().settings.mesh, coarsest);
  EXPECT_EQ(choice.status, Status::converged);
  const SettingsChoice own = choose_settings(scene, kGoal, [&](const Settings& s) {
    AccuracyAnswer answer = probe(s);
    if (s.mesh < 1) answer.evaluation.status = failed_at("asymptote", to_string(Status::iteration_limit));
    return answer;
  });
  ASSERT_GE(own.rounds.size(), 2U);
  EXPECT_EQ(own.rounds[1].settings.mesh, 1);
  EXPECT_EQ(own.status, Status::converged);
}

// Knobs that leave next to nothing stay where the accuracy is out of reach for another reason.
TEST(Accuracy, TurnsNoKnobThatBuysNothing) {
  AccuracyGoal goal = kGoal;
  goal.fixed = {"mesh.flank_elements", "solver.harmonics", "solver.samples"};
  const Laws laws{.mesh = 0.05, .modes = 2e-4};
  const SettingsChoice choice = choose_settings(Scene{}, goal, [&](const Settings& s) {
    Evaluation evaluation = laws.probe()(s).evaluation;
    evaluation.error_sources[kVolume]["edge"] = 0.07;
    return evaluation;
  });
  EXPECT_EQ(choice.status, Status::iteration_limit);
  EXPECT_LE(choice.settings.modes, Scene{}.solver.modes);
  ASSERT_TRUE(choice.tried.by);
  EXPECT_NEAR(choice.tried.by->whole - choice.tried.by->relative, 0.07, 1e-12);
}

// A part of a node at the ends of zones is a shorter one on a finer mesh.
TEST(Accuracy, WhatAFollowedResonanceLeavesOfTheEndsOfZonesIsBought) {
  const Laws laws{.mesh = 0.001, .harmonics = 0.001, .samples = 0.001};
  const SettingsChoice choice = choose_settings(Scene{}, kGoal, [&](const Settings& s) {
    AccuracyAnswer answer = laws.probe()(s);
    answer.evaluation.error_sources[kVolume]["zone_ends"] = 0.04 / s.mesh;
    return answer;
  });
  EXPECT_EQ(choice.status, Status::converged);
  EXPECT_GT(choice.settings.mesh, 2);
}

TEST(Accuracy, OfOneResponseMayBeAnother) {
  AccuracyGoal goal = kGoal;
  goal.of[kVolume] = 0.005;
  const SettingsChoice finer = choose_settings(Scene{}, goal, Laws{}.probe());
  EXPECT_EQ(finer.status, Status::converged);
  EXPECT_LE(Laws{}.sum(finer.settings), 0.005);
  EXPECT_EQ(finer.tried.by->asked, 0.005);
}

TEST(Accuracy, SettingsWithoutAnAnswerAreLeftAside) {
  const Laws laws;
  // What is tried second has no answer.
  const SettingsChoice without = choose_settings(Scene{}, kGoal, laws.probe());
  ASSERT_GE(without.rounds.size(), 2U);
  const Settings bad = without.rounds[1].settings;
  const SettingsChoice choice = choose_settings(Scene{}, kGoal, [&](const Settings& s) {
    Evaluation evaluation = laws.probe()(s).evaluation;
    if (s == bad) evaluation.status = failed_at("asymptote", to_string(Status::iteration_limit));
    return evaluation;
  });
  EXPECT_EQ(choice.status, Status::converged);
  EXPECT_FALSE(choice.settings == bad);
  const SettingsChoice none = choose_settings(Scene{}, kGoal, [](const Settings&) {
    Evaluation evaluation;
    evaluation.status = failed_at("mesh", "inverted");
    return evaluation;
  });
  EXPECT_EQ(none.status, Status::stalled);
  EXPECT_TRUE(none.settings == settings_of(Scene{}));
}

// The true error, by a model with 2.7 times the edges, twice the harmonics and samples: within the accuracy.
TEST(Accuracy, HoldsAgainstAFinerModel) {
  const Scene scene = coarse_scene();
  AccuracyGoal goal{.relative = 0.05, .responses = {kVolume, "peak_amplitude_m", "blade_fillet_stress_pa"}};
  const SettingsChoice choice = choose_settings(scene, scene, goal);
  ASSERT_EQ(choice.status, Status::converged);
  Settings fine = choice.settings;
  fine.mesh *= 8.0 / 3;
  fine.beside *= 8.0 / 3;
  fine.harmonics = 2 * fine.harmonics + 1;
  fine.samples *= 2;
  fine.modes *= 2;
  const Evaluation reference =
      SceneEvaluator(with_settings(scene, fine)).evaluate(with_settings(scene, fine), kSearch).evaluation;
  ASSERT_TRUE(reference.converged()) << reference.status;
  for (const std::string& name : goal.responses)
    EXPECT_NEAR(choice.evaluation.responses.at(name), reference.responses.at(name),
                goal.relative * reference.responses.at(name))
        << name;
}

}  // namespace
}  // namespace dovetail::optimizer
