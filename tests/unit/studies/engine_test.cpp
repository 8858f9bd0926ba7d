#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "optimizer/candidate/candidate_model.hpp"
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

}  // namespace
}  // namespace dovetail::optimizer
