#include "core/budget.hpp"

#include <gtest/gtest.h>

#include "paths/resonance.hpp"
#include "paths/steady_state.hpp"
#include "steady/preload.hpp"
#include "steady/work.hpp"
#include "tests/unit/steady/random_model.hpp"

namespace dovetail {
namespace {

constexpr int kNodes = 3, kHarmonics = 3, kSamples = 64;

std::shared_ptr<const dynamics::CondensedModel> model() {
  return std::make_shared<const dynamics::CondensedModel>(random_model(kNodes, 2, Damping::proportional));
}

SharedBudget jacobians(double count) {
  return std::make_shared<Budget>(count * steady::jacobian_operations(kNodes, 3, kHarmonics, kSamples));
}

steady::Options options(SharedBudget budget) {
  return {.harmonics = kHarmonics, .samples = kSamples, .budget = std::move(budget)};
}

TEST(Budget, NamesItselfAsTheReasonOnlyOfWhatFailed) {
  const auto spent_one = std::make_shared<Budget>(1.0);
  EXPECT_EQ(within(spent_one, Status::stalled), Status::stalled);
  spent_one->spend(1.0);
  EXPECT_EQ(within(spent_one, Status::stalled), Status::budget_spent);
  EXPECT_EQ(within(spent_one, Status::converged), Status::converged);
  EXPECT_EQ(within(spent_one, Status::interrupted), Status::interrupted);
  EXPECT_EQ(within(nullptr, Status::stalled), Status::stalled);
  EXPECT_TRUE(Budget(kInfinity, 1e-9).spent());
}

TEST(Budget, APartOfTheRestKnowsWhatWasSpent) {
  Budget whole(10.0);
  whole.spend(6.0);
  Budget part = whole.part_of_rest(0.5);
  part.spend(1.9);
  EXPECT_FALSE(part.spent());
  part.spend(0.1);
  EXPECT_TRUE(part.spent());
  EXPECT_EQ(whole.used(), 6.0);
  whole.spend(4.0);
  EXPECT_TRUE(whole.part_of_rest(0.5).spent());
  EXPECT_FALSE(Budget().part_of_rest(0.5).spent());
}

// What is counted belongs to the computation alone, and a budget that is not spent changes nothing.
TEST(Budget, CountsTheSameEveryTime) {
  const SharedBudget first = std::make_shared<Budget>(), second = jacobians(1e6);
  const steady::State one = paths::steady_state({model(), {}, options(first)}, 1.1);
  const steady::State other = paths::steady_state({model(), {}, options(second)}, 1.1);
  const steady::State free = paths::steady_state({model(), {}, options(nullptr)}, 1.1);
  ASSERT_EQ(free.status, Status::converged);
  EXPECT_GT(first->used(), 0.0);
  EXPECT_EQ(first->used(), second->used());
  EXPECT_EQ(one.displacement, free.displacement);
  EXPECT_EQ(other.displacement, free.displacement);
}

// Nodes that a constant force pulls off and nothing holds have no steady state: the cascade of pseudo-penalties,
// Powell's method and all rescues are tried. Past its budget a solve may finish the Jacobian at hand and march the
// start of one more attempt.
TEST(Budget, EndsAHopelessSolve) {
  reduction::ReducedModel pulled_off = random_model(kNodes, 2, Damping::proportional);
  for (const int normal : pulled_off.contact.normal) {
    pulled_off.static_force(normal) = -1;
    for (Eigen::MatrixXd* matrix : {&pulled_off.stiffness, &pulled_off.damping}) {
      matrix->row(normal).setZero();
      matrix->col(normal).setZero();
    }
  }
  for (const double count : {0.5, 3.0, 40.0, 300.0}) {
    const SharedBudget budget = jacobians(count);
    const steady::State state =
        paths::steady_state({std::make_shared<const dynamics::CondensedModel>(pulled_off), {}, options(budget)}, 1.1);
    EXPECT_EQ(state.status, Status::budget_spent) << count << ": " << to_string(state.status);
    EXPECT_LE(budget->used(), (count + 4) * steady::jacobian_operations(kNodes, 3, kHarmonics, kSamples)) << count;
  }
}

TEST(Budget, EndsASearchForAResonanceAndAPreload) {
  const SharedBudget budget = jacobians(1.0);
  const paths::Resonance found = paths::resonance({model(), {}, options(budget)}, 1.1);
  EXPECT_EQ(found.status, Status::budget_spent) << to_string(found.status);
  EXPECT_FALSE(found.swept);
  const steady::Preload preload = steady::quasi_static(model(), {.budget = budget});
  EXPECT_EQ(preload.status, Status::budget_spent) << to_string(preload.status);
  EXPECT_EQ(steady::quasi_static(model()).status, Status::converged);
}

// A search range too small for any peak leaves it to the sweep; each of its points takes a few Jacobians, and a step
// that is under way is finished: a corrector, two tangents and a peak, 12 + 3 + 60 at most.
TEST(ResonanceSearch, FollowsTheBranchWithinItsLimit) {
  const paths::ResonanceOptions all{.search_range = 1e-6};
  paths::ResonanceOptions few = all;
  few.max_sweep_jacobians = 20;
  const paths::Resonance whole = paths::resonance({model(), {}, options(nullptr)}, 3.0, all);
  const paths::Resonance part = paths::resonance({model(), {}, options(nullptr)}, 3.0, few);
  EXPECT_TRUE(part.swept || part.status != Status::converged);
  EXPECT_GT(whole.jacobians, 200);
  EXPECT_LT(part.jacobians, 120);
}

}  // namespace
}  // namespace dovetail
