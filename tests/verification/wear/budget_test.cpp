#include "core/budget.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <memory>

#include "scenes.hpp"
#include "wear/asymptote/asymptote.hpp"
#include "wear/history/history.hpp"

// Whatever part of the work a wear computation needs it is allowed, it says that its budget was spent or gives the
// answer it gives without one.

namespace dovetail::wear {
namespace {

std::shared_ptr<const dynamics::CondensedModel> block() {
  return std::make_shared<const dynamics::CondensedModel>(scenes::block(scenes::random_block(1)));
}

steady::Options within_budget(const SharedBudget& budget) {
  return {.harmonics = 3, .samples = 64, .budget = budget};
}

constexpr double kShares[] = {1e-3, 0.05, 0.15, 0.3, 0.45, 0.6, 0.75, 0.9, 0.97};

double work(const std::function<void(const SharedBudget&)>& compute) {
  const auto counted = std::make_shared<Budget>();
  compute(counted);
  return counted->used();
}

TEST(WearBudget, OfAnAsymptote) {
  const auto model = block();
  const auto compute = [&](const SharedBudget& budget) {
    AsymptoteOptions options;
    options.rate_threshold = 0.0;
    return asymptote({model, {}, within_budget(budget)}, 1.0, options);
  };
  const Asymptote whole = compute(nullptr);
  ASSERT_EQ(whole.verdict, Verdict::asymptote);
  const double needed = work([&](const SharedBudget& budget) { (void)compute(budget); });
  int cut = 0;
  for (const double share : kShares) {
    const Asymptote part = compute(std::make_shared<Budget>(share * needed));
    if (part.verdict == Verdict::asymptote) {
      EXPECT_LT((part.depth - whole.depth).cwiseAbs().maxCoeff(), 1e-6 * whole.largest_depth) << share;
      continue;
    }
    ++cut;
    EXPECT_EQ(part.verdict, Verdict::not_converged) << share;
    EXPECT_EQ(part.status, Status::budget_spent) << share << ": " << dovetail::to_string(part.status);
  }
  EXPECT_GE(cut, 2);
}

TEST(WearBudget, OfHistories) {
  const auto model = block();
  const auto explicit_one = [&](const SharedBudget& budget) {
    return history({model, {}, within_budget(budget)}, {.omega = 1.0},
                   {.increment = 1e-5, .steps = 300, .rate_threshold = 0.0});
  };
  const auto implicit_one = [&](const SharedBudget& budget) {
    HistoryOptions options = HistoryOptions::implicit();
    options.rate_threshold = 0.0;
    return history({model, {}, within_budget(budget)}, {.omega = 1.0}, options);
  };
  for (const auto& compute : {std::function<History(const SharedBudget&)>(explicit_one),
                              std::function<History(const SharedBudget&)>(implicit_one)}) {
    const History whole = compute(nullptr);
    ASSERT_EQ(whole.status, Status::converged) << to_string(whole.end);
    const double needed = work([&](const SharedBudget& budget) { (void)compute(budget); });
    for (const double share : kShares) {
      const History part = compute(std::make_shared<Budget>(share * needed));
      // The last part of a history is its finish by the direct method, which may be left out.
      if (part.end == whole.end) {
        EXPECT_GT(share, 0.5);
        continue;
      }
      EXPECT_EQ(part.end, HistoryEnd::failed) << share << ": " << to_string(part.end);
      EXPECT_EQ(part.status, Status::budget_spent) << share << ": " << dovetail::to_string(part.status);
    }
  }
}

}  // namespace
}  // namespace dovetail::wear
