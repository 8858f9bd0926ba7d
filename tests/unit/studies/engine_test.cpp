#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "optimizer/candidate/candidate_model.hpp"
#include "optimizer/cases.hpp"
#include "optimizer/problem/uncertainty.hpp"
#include "studies/program/engine/engine.hpp"

namespace dovetail::optimizer {
namespace {

using testing::HasSubstr;

/// So many sectors that their slots leave no disk between them: the outline crosses itself.
Scene impossible() {
  Scene scene;
  scene.geometry.sectors = 90;
  return scene;
}

TEST(ModelBuilder, MeshesADesignOnItsOwnWhenTheReferenceCannotBeMeshed) {
  const CandidateModel candidate = ModelBuilder(impossible()).build(Scene{});
  ASSERT_EQ(candidate.status, "converged");
  EXPECT_EQ(candidate.sizes.at("remeshed"), 1);
  ASSERT_EQ(candidate.messages.size(), 1U);
  EXPECT_THAT(candidate.messages[0], HasSubstr("The reference design cannot be meshed"));
}

TEST(ModelBuilder, NamesTheRulesOfAnImpossibleReference) {
  const CandidateModel candidate = ModelBuilder(impossible()).build(impossible());
  EXPECT_EQ(candidate.status, "infeasible");
  EXPECT_FALSE(candidate.messages.empty());
}

TEST(ModelBuilder, RefusesMeshSizesOutOfRange) {
  Scene scene;
  scene.mesh.flank_elements = 0;
  EXPECT_THROW(ModelBuilder{scene}, InputError);
}

// What the preload changes in matrices that are shared is computed once for loads that leave the preload alone.
TEST(ModelBuilder, KeepsWhatAPreloadChanges) {
  Scene scene;
  scene.mesh = {.flank_elements = 8, .fillet_fraction = 0.4, .bulk_size = 6e-3, .aerofoil_elements = 8};
  scene.solver.prestress = Prestress::shared;
  const ModelBuilder builder(scene);
  Scene other = scene;
  other.contact.friction *= 0.9;
  Scene harder = other;
  harder.loading.tip_force *= 3;
  const CandidateModel first = builder.build(scene), second = builder.build(other), third = builder.build(harder);
  ASSERT_TRUE(third.converged()) << third.status;
  EXPECT_NE(second.matrices.trace.change, first.matrices.trace.change);
  EXPECT_EQ(third.matrices.trace.change, second.matrices.trace.change);
  const CandidateModel fresh = ModelBuilder(scene).build(harder);
  EXPECT_EQ(third.model.stiffness, fresh.model.stiffness);
  EXPECT_EQ((third.matrices.stiffness() - fresh.matrices.stiffness()).norm(), 0);
  // Other matrices are changed otherwise.
  harder.loading.speed *= 0.9;
  EXPECT_NE(builder.build(harder).matrices.trace.change, third.matrices.trace.change);
}

// Those of one speed have the matrices in common, and of them those of one friction the preload.
TEST(LoadCases, AreComputedInTheOrderOfWhatTheyShare) {
  std::vector<LoadCase> cases;
  for (const double force : {1, 2})
    for (const double friction : {0.4, 0.5})
      for (const double speed : {9000, 10000})
        cases.push_back({.name = std::to_string(cases.size()),
                         .changes = {{.key = "loading.tip_force_n", .value = force},
                                     {.key = "contact.friction", .value = friction},
                                     {.key = "scene.speed_rpm", .value = speed}}});
  EXPECT_THAT(by_what_they_share(cases), testing::ElementsAre(0, 4, 2, 6, 1, 5, 3, 7));
  EXPECT_THAT(by_what_they_share({}), testing::IsEmpty());
}

// A variable may start elsewhere than at the value in the file.
TEST(StudyEngine, StartsWhereTheVariablesStart) {
  studies::Study study;
  study.problem.space = DesignSpace({{.key = "geometry.flank_mismatch_um", .lower = -5, .upper = 25, .start = 12}});
  EXPECT_EQ(parameter(studies::start_scene(study), "geometry.flank_mismatch_um"), 12);
  EXPECT_EQ(parameter(study.scene, "geometry.flank_mismatch_um"), 0);
  EXPECT_EQ(parameter(studies::reference_scene(study), "geometry.flank_mismatch_um"), 10);
}

// Matrices that are stressed once for all cases are so with the friction of the first of them, taken once.
TEST(StudyEngine, StressesTheMatricesOfAllCasesAsInTheFirst) {
  studies::Study study;
  study.problem.cases = {{.name = "a", .changes = {{.key = "contact.friction", .value = -0.1, .times = 1}}},
                         {.name = "b", .changes = {{.key = "contact.friction", .value = 0.3}}}};
  const double friction = study.scene.contact.friction;
  EXPECT_EQ(studies::evaluator_reference(study).contact.friction, friction);
  study.scene.solver.prestress = Prestress::cases;
  EXPECT_DOUBLE_EQ(studies::evaluator_reference(study).contact.friction, friction - 0.1);
  study.scene = studies::reference_scene(study);
  EXPECT_DOUBLE_EQ(studies::evaluator_reference(study).contact.friction, friction - 0.1);
}

// Whatever bounds were held against: a run comes to its report.
TEST(StudyEngine, DescribesADesignThatIsRefusedAsFailed) {
  studies::Study study;
  study.scene.mesh = {.flank_elements = 8, .fillet_fraction = 0.4, .bulk_size = 6e-3, .aerofoil_elements = 8};
  study.problem.space =
      DesignSpace({{.key = "contact.normal_stiffness_n_per_m3", .lower = 1e7, .upper = 1e13, .start = 1e7}});
  const studies::RunEngine engine = studies::study_engine(study);
  study.scene.contact.normal_stiffness = 1e7;
  const studies::DescribedDesign described = engine.describe(study.scene);
  EXPECT_THAT(described.evaluation.status,
              HasSubstr("scene: contact.normal_stiffness_n_per_m3 = 1e+07: must be 0 (rigid) or >= 1e+09"));
  EXPECT_EQ(described.record.status, described.evaluation.status);
}

Evaluation by_force(const Scene& scene, std::size_t) {
  Evaluation e;
  e.responses["force"] = scene.loading.tip_force;
  e.responses["friction"] = scene.contact.friction;
  e.error_estimates["force"] = 0.1 * scene.loading.tip_force;
  e.model["jacobians_spent"] = 3;
  e.constraints["rule:wall"] = scene.loading.tip_force - 4;
  if (scene.loading.tip_force > 5) e.status = failed_at("unworn_resonance", Status::no_bracket);
  return e;
}

TEST(Cases, EachIsEvaluatedWithItsOwnKeys) {
  const std::vector<LoadCase> cases{
      {.name = "plain", .weight = 1, .changes = {}},
      {.name = "hard", .changes = {{"loading.tip_force_n", 3}, {"contact.friction", 0.3}}}};
  Scene scene;
  const Evaluation e = evaluated_in_cases(cases, scene, by_force);
  EXPECT_EQ(e.status, "converged");
  EXPECT_EQ(e.responses.at("force"), scene.loading.tip_force);
  EXPECT_EQ(e.responses.at("force@plain"), scene.loading.tip_force);
  EXPECT_EQ(e.responses.at("force@hard"), 3);
  EXPECT_EQ(e.responses.at("friction@hard"), 0.3);
  EXPECT_EQ(e.error_estimates.at("force@hard"), 0.1 * 3);
  EXPECT_EQ(e.model.at("jacobians_spent"), 6);
  EXPECT_EQ(e.constraints.at("rule:wall"), -1);
  EXPECT_EQ(e.parameters, parameters(scene));
  // A look at a finer mesh has that of its answers.
  const auto finer = [](Scene there, std::size_t load) {
    there.mesh.flank_elements *= 2;
    Evaluation answer = by_force(there, load);
    answer.parameters = parameters(there);
    return answer;
  };
  const std::map<std::string, double> there = evaluated_in_cases(cases, scene, finer).parameters;
  EXPECT_EQ(there.at("mesh.flank_elements"), 2 * scene.mesh.flank_elements);
  EXPECT_EQ(there.at("contact.friction"), scene.contact.friction);
  EXPECT_EQ(evaluated_in_cases({}, scene, by_force).responses, by_force(scene, 0).responses);
}

TEST(Cases, AFailureNamesItsCase) {
  const std::vector<LoadCase> cases{{.name = "plain", .changes = {}},
                                    {.name = "hard", .changes = {{"loading.tip_force_n", 6}}}};
  const Evaluation e = evaluated_in_cases(cases, Scene{}, by_force);
  EXPECT_EQ(e.status, "case hard: unworn_resonance: no_bracket");
  EXPECT_FALSE(e.converged());
  EXPECT_TRUE(e.responses.contains("force@plain"));
}

Evaluation all_forces(const MissionCases& mission, std::size_t place) {
  Evaluation e;
  e.responses["mission_wear_volume_m3"] = static_cast<double>(place);
  for (const char* name : {"plain", "hard"}) e.responses[of_case("mission_drift", name)] = name[0];
  e.error_estimates["mission_wear_volume_m3"] = static_cast<double>(mission.cases.size());
  e.model["mission_order_matters"] = 1;
  return e;
}

const std::vector<LoadCase> kTwoCases{{.name = "plain", .changes = {}},
                                      {.name = "hard", .changes = {{"loading.tip_force_n", 3}}}};

TEST(Missions, AreOfAllCasesAndToldByEach) {
  const std::vector<MissionCases> missions = missions_of(kTwoCases, true);
  ASSERT_EQ(missions.size(), 1U);
  EXPECT_EQ(missions[0].cases, (std::vector<std::size_t>{0, 1}));
  const Evaluation e = evaluated_in_cases(kTwoCases, Scene{}, by_force, missions, all_forces);
  ASSERT_EQ(e.status, "converged");
  for (const char* name : {"mission_wear_volume_m3", "mission_wear_volume_m3@plain", "mission_wear_volume_m3@hard"}) {
    EXPECT_EQ(e.responses.at(name), 2) << name;  // evaluated after the cases
    EXPECT_EQ(e.error_estimates.at(name), 2) << name;
  }
  EXPECT_EQ(e.responses.at("mission_drift"), 'p');
  EXPECT_EQ(e.responses.at("mission_drift@plain"), 'p');
  EXPECT_EQ(e.responses.at("mission_drift@hard"), 'h');
  EXPECT_EQ(e.model.at("mission_order_matters@hard"), 1);
}

// Of numbers that are not known, each sample is a world of its own.
TEST(Missions, AreOfTheCasesOfEachSample) {
  const std::vector<LoadCase> samples =
      sampled(kTwoCases, {{.key = "contact.friction", .first = 0.3, .second = 0.5}}, {});
  const std::vector<MissionCases> missions = missions_of(samples, false);
  ASSERT_EQ(missions.size(), 3U);
  for (const MissionCases& mission : missions) {
    ASSERT_EQ(mission.cases.size(), 2U);
    EXPECT_EQ(samples[mission.cases[0]].sample_of, "plain");
    EXPECT_EQ(samples[mission.cases[1]].sample_of, "hard");
    EXPECT_EQ(samples[mission.cases[0]].changes.back().value, samples[mission.cases[1]].changes.back().value);
  }
  EXPECT_TRUE(missions_of(sampled({}, {{.key = "contact.friction", .first = 0.3, .second = 0.5}}, {}), false).empty());
}

TEST(Missions, NeedOneShape) {
  std::vector<LoadCase> cases = kTwoCases;
  cases[1].changes.push_back({"geometry.flank_length_mm", 5});
  EXPECT_TRUE(missions_of(cases, true).empty());
  cases[0].changes.push_back({"geometry.flank_length_mm", 5});
  EXPECT_EQ(missions_of(cases, true).size(), 1U);
  EXPECT_EQ(missions_of({}, true).size(), 1U);
  EXPECT_TRUE(missions_of({}, false).empty());
}

// A failure counts where the study names the mission; else it is told.
TEST(Missions, FailAsTheyAreNeeded) {
  const auto fails = [](const MissionCases&, std::size_t) {
    Evaluation e;
    e.status = failed_at("asymptote", Status::gross_sliding);
    return e;
  };
  const Evaluation named = evaluated_in_cases(kTwoCases, Scene{}, by_force, missions_of(kTwoCases, true), fails);
  EXPECT_EQ(named.status, "mission: asymptote: gross_sliding");
  const Evaluation shown = evaluated_in_cases(kTwoCases, Scene{}, by_force, missions_of(kTwoCases, false), fails);
  EXPECT_EQ(shown.status, "converged");
  ASSERT_EQ(shown.messages.size(), 1U);
  EXPECT_THAT(shown.messages[0], HasSubstr("asymptote: gross_sliding"));
  // After a case that failed none is looked at.
  std::vector<LoadCase> cases = kTwoCases;
  cases[1].changes[0].value = 6;
  EXPECT_EQ(evaluated_in_cases(cases, Scene{}, by_force, missions_of(cases, true), fails).status,
            "case hard: unworn_resonance: no_bracket");
}

// The physics: a case is what the study would be with its keys.
TEST(Cases, AreWhatTheStudyWouldBeWithTheirKeys) {
  studies::Study study;
  study.scene.mesh = {.flank_elements = 8, .fillet_fraction = 0.4, .bulk_size = 6e-3, .aerofoil_elements = 8};
  study.scene.solver.harmonics = 1;
  study.problem.objective = {{.response = "peak_amplitude_m"}};
  study.problem.cases = {{.name = "plain", .changes = {}}, {.name = "fast", .changes = {{"scene.speed_rpm", 11000}}}};
  const Evaluation e = studies::study_engine(study).evaluate({});
  ASSERT_EQ(e.status, "converged");
  study.problem.cases.clear();
  EXPECT_EQ(studies::study_engine(study).evaluate({}).responses.at("peak_amplitude_m"),
            e.responses.at("peak_amplitude_m@plain"));
  set_parameter(study.scene, "scene.speed_rpm", 11000);
  EXPECT_EQ(studies::study_engine(study).evaluate({}).responses.at("peak_amplitude_m"),
            e.responses.at("peak_amplitude_m@fast"));
}

// What points of a front are looked at with, missions too.
TEST(Missions, HaveBarsWhereTheyAreAskedFor) {
  studies::Study study;
  study.scene.mesh = {.flank_elements = 8, .fillet_fraction = 0.4, .bulk_size = 6e-3, .aerofoil_elements = 8};
  study.scene.solver.harmonics = 1;
  study.problem.objective = {{.response = "mission_wear_volume_m3"}};
  study.problem.cases = {{.name = "plain", .changes = {}}, {.name = "hard", .changes = {{"loading.tip_force_n", 3}}}};
  const studies::RunEngine engine = studies::study_engine(study);
  const Evaluation searched = engine.evaluate({}), barred = engine.barred({});
  ASSERT_EQ(searched.status, "converged");
  ASSERT_EQ(barred.status, "converged");
  EXPECT_FALSE(searched.error_estimates.contains("mission_wear_volume_m3"));
  EXPECT_GT(barred.error_estimates.at("mission_wear_volume_m3"), 0);
}

}  // namespace
}  // namespace dovetail::optimizer
