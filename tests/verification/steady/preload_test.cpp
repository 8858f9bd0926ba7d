#include "steady/preload.hpp"

#include <gtest/gtest.h>

#include "paths/steady_state.hpp"
#include "tests/verification/steady/rod.hpp"

namespace dovetail::verification {
namespace {

// A block on a spring k along the contact, pressed by P and pulled by Q, both ramped: while Q <= mu P it stays, beyond
// it slides until k x = Q - mu P. A second, softer spring k_N holds the normal direction against the gap g.
reduction::ReducedModel block(double pull, double gap) {
  reduction::ReducedModel model = empty_model(2, 1, 1);
  model.stiffness(0, 0) = 4;   // tangential
  model.stiffness(1, 1) = 10;  // normal
  model.contact.tangential << 0;
  model.contact.normal << 1;
  model.contact.friction << 0.3;
  model.contact.gap << gap;
  model.contact.area << 2;
  model.static_force << pull, 5;
  return model;
}

TEST(Preload, SlidesTheBlockByHand) {
  // Contact force: P - k_N g = 5 - 10 * 0.1 = 4 at the end, but nothing before u_N = 0.1 at a fifth of the load.
  const steady::Preload preload = steady::quasi_static(condensed(block(2, 0.1)), {.steps = 50});
  ASSERT_EQ(preload.status, Status::converged);
  EXPECT_NEAR(preload.force(0), 4, 1e-9);
  EXPECT_NEAR(preload.pressure(0), 2, 1e-9);
  EXPECT_NEAR(preload.force(1), 0.3 * 4, 1e-9);
  EXPECT_NEAR(preload.displacement(0), 0.1, 1e-12);
  EXPECT_NEAR(preload.displacement(1), (2 - 1.2) / 4, 1e-9);
  EXPECT_NEAR(preload.slip_origin(0, 0), (2 - 1.2) / 4, 1e-9);
  EXPECT_NEAR(preload.friction_use(0), 1, 1e-9);
}

TEST(Preload, KeepsTheBlockThatNeverReachesItsLimit) {
  const steady::Preload preload = steady::quasi_static(condensed(block(1, -0.2)), {.steps = 10});
  ASSERT_EQ(preload.status, Status::converged);
  // Interference 0.2 presses with k_N 0.2 before any load: 7 N at the end, limit 2.1 N.
  EXPECT_NEAR(preload.force(0), 7, 1e-9);
  EXPECT_NEAR(preload.force(1), 1, 1e-9);
  EXPECT_NEAR(preload.slip_origin(0, 0), 0, 1e-12);
}

TEST(Preload, HoldsABodyThatFloatsWithoutContact) {
  // No stiffness of its own along the contact normal: the body rests on two nodes sharing the weight 3 : 1.
  reduction::ReducedModel model = empty_model(4, 2, 1);
  // Dofs 0, 1: normal displacements of a rigid beam's ends; internal springs of the foundation enter as none.
  model.stiffness(2, 2) = model.stiffness(3, 3) = 1;
  model.contact.normal << 0, 1;
  model.contact.tangential << 2, 3;
  model.contact.friction << 0.2, 0.2;
  model.static_force << 3, 1, 0.1, 0.1;
  const steady::Preload preload = steady::quasi_static(condensed(model));
  ASSERT_EQ(preload.status, Status::converged);
  EXPECT_NEAR(preload.force(0), 3, 1e-9);
  EXPECT_NEAR(preload.force(2), 1, 1e-9);
  EXPECT_NEAR(preload.displacement.norm(), 0, 1e-12);
}

TEST(Preload, StartsTheVibration) {
  reduction::ReducedModel model = block(2, 0.1);
  model.mass(0, 0) = 1;
  model.cosine_force(0, 0) = 0.2;
  const steady::Preload preload = steady::quasi_static(condensed(model));
  ASSERT_EQ(preload.status, Status::converged);
  model.contact.slip_origin = preload.slip_origin;
  const steady::State state = paths::steady_state({condensed(model), {}, {}}, 0.5);
  ASSERT_EQ(state.status, Status::converged);
  // At the limit a small push moves the block once by 0.2 / 4 and then its own spring holds it: stuck, higher by that.
  EXPECT_EQ(state.wear_rate(0), 0);
  EXPECT_NEAR(state.displacement(1, 0), 0.2 + 0.05, 1e-6);
}

}  // namespace
}  // namespace dovetail::verification
