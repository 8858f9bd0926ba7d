#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "optimizer/candidate/candidate_model.hpp"
#include "optimizer/cases.hpp"
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

// A variable may start elsewhere than at the value in the file.
TEST(StudyEngine, StartsWhereTheVariablesStart) {
  studies::Study study;
  study.problem.space = DesignSpace({{.key = "geometry.flank_mismatch_um", .lower = -5, .upper = 25, .start = 12}});
  EXPECT_EQ(parameter(studies::start_scene(study), "geometry.flank_mismatch_um"), 12);
  EXPECT_EQ(parameter(study.scene, "geometry.flank_mismatch_um"), 0);
  EXPECT_EQ(parameter(studies::reference_scene(study), "geometry.flank_mismatch_um"), 10);
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

}  // namespace
}  // namespace dovetail::optimizer
