// What companions of error bars take over from the design changes what they cost, not what they say.
#include <gtest/gtest.h>

#include <cmath>

#include "optimizer/bars/other_meshes.hpp"
#include "optimizer/candidate/candidate_result.hpp"
#include "optimizer/responses/computed.hpp"
#include "tests/verification/optimizer/coarse_scene.hpp"

namespace dovetail::optimizer {
namespace {

const CandidateResult& own() {
  static const CandidateResult result =
      computed(coarse_scene(), ModelBuilder(coarse_scene()).build(coarse_scene()), Computation{});
  return result;
}

/// The scene from nothing and from the design, with its grid or without.
void expect_the_same(const Scene& scene, bool grid) {
  const CandidateModel model = ModelBuilder(scene).build(scene);
  const Evaluation alone = computed(scene, model, {}).evaluation;
  CandidateModel again = model;
  renew_budget(scene.solver, again);
  const Evaluation begun = computed(scene, again, {.from = &own(), .grid_from = grid}).evaluation;
  ASSERT_TRUE(own().evaluation.converged() && alone.converged() && begun.converged()) << begun.status;
  // Edges of worn zones are known to 0.02 of an edge of the mesh, and a grid that begins elsewhere ends there.
  for (const auto& [name, value] : alone.responses) {
    const double tolerance = name.starts_with("asymptotic") || name.ends_with("drift") ? 1e-2 : 1e-3;
    EXPECT_NEAR(begun.responses.at(name), value, tolerance * std::abs(value)) << name;
  }
  EXPECT_LT(begun.model.at("jacobians_spent"), 0.9 * alone.model.at("jacobians_spent"));
}

TEST(Companions, OfMoreHarmonicsEndWhereTheyWouldFromNothing) {
  Scene scene = coarse_scene();
  scene.solver.harmonics = 11;
  scene.solver.samples = 256;
  expect_the_same(scene, true);
}

TEST(Companions, OnAnotherMeshEndWhereTheyWouldFromNothing) {
  expect_the_same(resized(coarse_scene(), 1 / 1.5), false);
}

// On its own grid, from its own state, a design is what it was: to the digits to which its states are known.
TEST(Companions, WithNothingChangedAreTheDesign) {
  const CandidateResult again = computed(coarse_scene(), own().model, {.from = &own(), .grid_from = true});
  ASSERT_TRUE(again.evaluation.converged()) << again.evaluation.status;
  EXPECT_EQ(again.model.cells.flanks, own().model.cells.flanks);
  for (const auto& [name, value] : own().evaluation.responses) {
    const bool drifts = name.ends_with("drift");
    EXPECT_NEAR(again.evaluation.responses.at(name), value,
                drifts ? coarse_scene().solver.resonance_tolerance : 1e-5 * std::abs(value))
        << name;
  }
}

// Mesh, prestress and factor are those of the design with fewer modes.
TEST(Companions, WithMoreModesAreThoseOfTheSameStiffness) {
  const ModelBuilder builder(coarse_scene());
  const CandidateModel first = builder.build(coarse_scene());
  Scene scene = coarse_scene();
  scene.solver.modes = 40;
  const CandidateModel more = builder.build(scene), fresh = ModelBuilder(scene).build(scene);
  ASSERT_TRUE(first.converged() && more.converged() && fresh.converged()) << more.status;
  EXPECT_FALSE(more.timings_s.contains("assembly"));
  EXPECT_TRUE(fresh.timings_s.contains("assembly"));
  ASSERT_EQ(more.glued_frequencies.size(), fresh.glued_frequencies.size());
  EXPECT_GT(more.glued_frequencies.size(), first.glued_frequencies.size());
  EXPECT_LT(
      ((more.glued_frequencies - fresh.glued_frequencies).array() / fresh.glued_frequencies.array()).abs().maxCoeff(),
      1e-12);
  // And back: the ones before are not kept beside them, but what they share is.
  EXPECT_FALSE(builder.build(coarse_scene()).timings_s.contains("assembly"));
  scene.loading.speed *= 1.01;
  EXPECT_TRUE(builder.build(scene).timings_s.contains("assembly"));
}

}  // namespace
}  // namespace dovetail::optimizer
