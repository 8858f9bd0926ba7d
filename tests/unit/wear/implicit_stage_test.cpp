#include "wear/history/implicit_stage.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "paths/steady_state.hpp"
#include "tests/unit/steady/random_model.hpp"

namespace dovetail::wear {
namespace {

// Depths of a stage are those that its own rates wear, with the factors it was given: the equations are solved by
// products with their Jacobian.
TEST(ImplicitStage, SolvesBothEquationsWithFactorsOfAnotherPoint) {
  const auto model = std::make_shared<const dynamics::CondensedModel>(random_model(60, 1, Damping::within));
  const steady::Joint joint{model, {}, {.tolerance = 1e-11}};
  const steady::State from = paths::steady_state(joint, 1.3);
  ASSERT_EQ(from.status, Status::converged);
  ImplicitStage stage(joint, from, 0);
  const Eigen::VectorXd base = Eigen::VectorXd::Zero(60);
  const double largest = from.wear_rate.maxCoeff();
  ASSERT_GT(largest, 0);
  for (const double depth : {1e-2, 1.0}) {
    WearPoint at{.displacement = from.displacement, .depth = base, .rate = from.wear_rate};
    const Eigen::VectorXd cycles = Eigen::VectorXd::Constant(60, depth / largest);
    ASSERT_EQ(stage.solve(base, cycles, 10, at), Status::converged);
    EXPECT_GT(at.depth.maxCoeff(), 0.2 * depth);
    EXPECT_LT((at.depth - cycles.cwiseProduct(at.rate)).norm(), 1e-9 * at.depth.norm());
    const steady::State there = stage.described(at);
    EXPECT_LT((there.wear_rate - at.rate).norm(), 1e-9 * at.rate.norm());
    EXPECT_LT((there.wear_rate - from.wear_rate).norm(), from.wear_rate.norm());
    EXPECT_GT((there.wear_rate - from.wear_rate).norm(), 1e-3 * from.wear_rate.norm());
  }
  EXPECT_EQ(stage.jacobians(), 0) << "factorised anew";
}

}  // namespace
}  // namespace dovetail::wear
