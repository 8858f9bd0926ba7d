#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "optimizer/candidate/candidate_model.hpp"

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

}  // namespace
}  // namespace dovetail::optimizer
