#include "wear/history/history.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "scenes.hpp"
#include "wear/asymptote/asymptote.hpp"
#include "wear/measures.hpp"

namespace dovetail::wear {
namespace {

const steady::Options kSteady{.harmonics = 3, .samples = 64};

using Model = std::shared_ptr<const dynamics::CondensedModel>;

Model block(unsigned number) {
  return std::make_shared<const dynamics::CondensedModel>(scenes::block(scenes::random_block(number)));
}

HistoryOptions implicit_down_to_nothing() {
  HistoryOptions options = HistoryOptions::implicit();
  options.rate_threshold = 0.0;
  return options;
}

AsymptoteOptions alone() {
  AsymptoteOptions options;
  options.rate_threshold = 0.0;
  options.arbitration = Arbitration::never;
  return options;
}

// Where the worn state is unique, the finished history lands on it exactly, at a tenth of the steps of explicit ones.
TEST(ImplicitHistory, EndsInTheWornState) {
  for (unsigned number : {1u, 2u, 3u, 4u, 5u}) {
    const Model model = block(number);
    const Asymptote direct = asymptote({model, {}, kSteady}, 1.0, alone());
    ASSERT_EQ(direct.verdict, Verdict::asymptote);
    const History run = history({model, {}, kSteady}, {.omega = 1.0}, implicit_down_to_nothing());
    ASSERT_EQ(run.end, HistoryEnd::worn_out) << to_string(run.end);
    EXPECT_TRUE(run.finished);
    const double error = (run.final_depth - direct.depth).cwiseAbs().maxCoeff() / direct.largest_depth;
    RecordProperty("jacobians_" + std::to_string(number), run.jacobians);
    // Both are W = max_t u_N - g of the same set of free nodes, solved to 1e-9 of the excitation.
    EXPECT_LT(error, 1e-6) << number;
    EXPECT_LE(run.jacobians, 60) << number;
  }
}

// Where it depends on the way, the volumes converge with the tolerance of the steps, and to that of explicit histories,
// whose error is first order in the increment: 0.4 % overshoot of single nodes.
TEST(ImplicitHistory, FollowsThePathOfExplicitOnes) {
  const Model model = block(0);
  const auto volume = [&](double tolerance) {
    HistoryOptions options = implicit_down_to_nothing();
    options.tolerance = tolerance;
    const History run = history({model, {}, kSteady}, {.omega = 1.0}, options);
    EXPECT_EQ(run.end, HistoryEnd::worn_out);
    return run.final_volume;
  };
  const double fine = volume(2e-5);
  EXPECT_NEAR(volume(2e-4), fine, 1e-3 * fine);
  const History run =
      history({model, {}, kSteady}, {.omega = 1.0},
              {.increment = 0.004 * 3.04e-4, .steps = 3000, .rate_fraction = 1e-5, .rate_threshold = 0.0});
  ASSERT_EQ(run.end, HistoryEnd::worn_out);
  EXPECT_NEAR(run.final_volume, fine, 4e-3 * fine);
}

TEST(ImplicitHistory, NeverGivesDepthBack) {
  const History run = history({block(6), {}, kSteady}, {.omega = 1.0}, implicit_down_to_nothing());
  ASSERT_EQ(run.end, HistoryEnd::worn_out);
  for (Eigen::Index i = 1; i < run.depth.rows(); ++i) {
    EXPECT_GE((run.depth.row(i) - run.depth.row(i - 1)).minCoeff(), 0.0) << i;
    EXPECT_GE(run.rate.row(i).minCoeff(), 0.0) << i;
    EXPECT_GT(run.cycles[i], run.cycles[i - 1]) << i;
  }
  EXPECT_GE((run.final_depth.transpose() - run.depth.bottomRows(1)).minCoeff(), 0.0);
}

// Closed form: p_N = N_0 - k_n W of a sliding node, W = N_0 / k_n at the end, and on the way p(n) as in
// den_hartog_wear_test. A local error of 2e-4 over 20 to 40 steps leaves below one per cent.
TEST(ImplicitHistory, UnloadsARubbingNode) {
  const Model model = std::make_shared<const dynamics::CondensedModel>(scenes::rubbing_oscillator(0.1, 2.0, 1.0, 0.05));
  const History run = history({model, {}, kSteady}, {.omega = 1.0}, implicit_down_to_nothing());
  ASSERT_EQ(run.end, HistoryEnd::worn_out);
  EXPECT_NEAR(run.final_depth[0], 0.05, 1e-4 * 0.05);
  const Eigen::Index half = run.cycles.size() / 2;
  const History fine = history({model, {}, kSteady}, {.omega = 1.0},
                               {.increment = 0.0005 * 0.05,
                                .steps = 4000,
                                .cycles = run.cycles[half],
                                .rate_fraction = 0.0,
                                .rate_threshold = 0});
  ASSERT_EQ(fine.end, HistoryEnd::cycles);
  EXPECT_NEAR(fine.final_depth[0], run.depth(half, 0), 5e-3 * 0.05);
}

TEST(ImplicitHistory, SaysThatItStoppedOrFailed) {
  int asked = 0;
  const Watcher watcher{.stop = [&asked] { return ++asked > 5; }};
  const History stopped = history({block(1), {}, kSteady}, {.omega = 1.0}, implicit_down_to_nothing(), watcher);
  EXPECT_EQ(stopped.end, HistoryEnd::interrupted);
  EXPECT_EQ(stopped.status, Status::interrupted);
  EXPECT_GT(stopped.cycles.size(), 1);
  steady::Options hasty = kSteady;
  hasty.max_iterations = 1;
  hasty.penalty_cascade = false;
  const History failed = history({block(1), {}, hasty}, {.omega = 1.0}, implicit_down_to_nothing());
  EXPECT_EQ(failed.end, HistoryEnd::failed);
  EXPECT_NE(failed.status, Status::converged);
  EXPECT_THROW((void)history({block(1), {}, kSteady}, {.omega = 1.0}, {.integrator = IntegratorKind::implicit_steps}),
               InputError);
  HistoryOptions following = HistoryOptions::implicit();
  following.follow = Follow::resonance;
  EXPECT_THROW((void)history({block(1), {}, kSteady}, {.omega = 1.0}, following), InputError);
  steady::Condition start;
  start.released.assign(static_cast<std::size_t>(block(1)->nodes()), 1);
  EXPECT_THROW((void)history({block(1), start, kSteady}, {.omega = 1.0}, HistoryOptions::implicit()), InputError);
}

// A history stopped on its way and resumed is the one that went on: of implicit ones the same factors, step and first
// rate. What is solved again is the last state, to 1e-10.
TEST(History, IsResumed) {
  const Model model = block(2);
  for (const bool implicit : {false, true}) {
    HistoryOptions options =
        implicit ? HistoryOptions::implicit()
                 : HistoryOptions{.increment = 4e-6, .steps = 1000, .rate_fraction = 1e-3, .rate_threshold = 0.0};
    const History whole = history({model, {}, kSteady}, {.omega = 1.0}, options);
    ASSERT_EQ(whole.end, HistoryEnd::worn_out);
    HistoryOptions some = options;
    some.steps = implicit ? 6 : 10;
    const History first = history({model, {}, kSteady}, {.omega = 1.0}, some);
    ASSERT_EQ(first.end, HistoryEnd::steps);
    ASSERT_EQ(first.cycles.size(), some.steps + 1);
    const History second = history({model, {}, kSteady}, {.omega = 1.0, .past = &first}, options);
    EXPECT_EQ(second.end, HistoryEnd::worn_out);
    ASSERT_EQ(second.cycles.size(), whole.cycles.size());
    const double close = implicit ? 1e-8 : 1e-4;
    EXPECT_LT((second.cycles - whole.cycles).cwiseAbs().maxCoeff(), close * whole.cycles.maxCoeff());
    EXPECT_LT((second.depth - whole.depth).cwiseAbs().maxCoeff(), close * whole.depth.maxCoeff());
  }
}

// With the error controlled, coarse increments lose their overshoot.
TEST(History, ControlsItsError) {
  const Model model = block(3);
  const Asymptote direct = asymptote({model, {}, kSteady}, 1.0, alone());
  const HistoryOptions coarse{
      .increment = 0.2 * direct.largest_depth, .steps = 2000, .rate_fraction = 1e-3, .rate_threshold = 0.0};
  HistoryOptions controlled = coarse;
  controlled.tolerance = 2e-3;
  const auto error = [&](const HistoryOptions& options) {
    const History run = history({model, {}, kSteady}, {.omega = 1.0}, options);
    EXPECT_EQ(run.end, HistoryEnd::worn_out) << to_string(run.end);
    return (run.final_depth - direct.depth).cwiseAbs().maxCoeff() / direct.largest_depth;
  };
  const double free = error(coarse);
  const double held = error(controlled);
  RecordProperty("free", std::to_string(free));
  RecordProperty("held", std::to_string(held));
  EXPECT_GT(free, 0.02);
  // 1/2 dN |r_new - r| is half the overshoot of a node that loses its load within the step.
  EXPECT_LT(held, 4.0 * controlled.tolerance);
}

TEST(History, OfTooFewStepsSaysSo) {
  const History run =
      history({block(2), {}, kSteady}, {.omega = 1.0}, {.increment = 4e-6, .steps = 8, .rate_threshold = 0.0});
  EXPECT_EQ(run.end, HistoryEnd::steps);
  ASSERT_EQ(run.cycles.size(), 9);
  EXPECT_FALSE(run.finished);
  EXPECT_EQ(run.final_volume, run.worn_volume[8]);
}

}  // namespace
}  // namespace dovetail::wear
