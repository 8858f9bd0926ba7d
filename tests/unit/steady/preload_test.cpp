#include "steady/preload.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/unit/steady/random_model.hpp"

namespace dovetail {
namespace {

/// Two nodes pressed and pulled at random: they close, stick and slide at one load or another.
std::shared_ptr<const dynamics::CondensedModel> pulled() {
  reduction::ReducedModel model = random_model(2, 1, Damping::proportional);
  std::mt19937 generator(22);
  std::normal_distribution<double> normal;
  for (Eigen::Index i = 0; i < 2; ++i) {
    model.static_force(model.contact.tangential(i, 0)) = normal(generator);
    model.contact.gap(i) = 0.2 * normal(generator);
    model.static_force(model.contact.normal(i)) = 2 + 2 * normal(generator);
  }
  model.contact.slip_origin = Eigen::MatrixXd::Zero(2, 1);
  return std::make_shared<const dynamics::CondensedModel>(model);
}

// Where a node changes what it does displacements do not go on as they did. One Jacobian does not lead from there to
// the state at the next load, but it does from the state before; else the step is rescued with springs, at 24 in all.
TEST(Preload, BeginsAStepWhereTheLastOneEndedWhenWhatWasForeseenFails) {
  const steady::Preload preload = steady::quasi_static(pulled(), {.steps = 10, .max_iterations = 1});
  ASSERT_EQ(preload.status, Status::converged);
  EXPECT_EQ(preload.iterations, 6);
  // As found with as many as it takes.
  const steady::Preload free = steady::quasi_static(pulled(), {.steps = 10});
  ASSERT_EQ(free.status, Status::converged);
  EXPECT_LT((preload.force - free.force).norm(), 1e-8 * free.force.norm());
}

}  // namespace
}  // namespace dovetail
