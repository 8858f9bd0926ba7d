#include "wear/asymptote/spread.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/errors.hpp"
#include "dynamics/condensed_model.hpp"
#include "paths/steady_state.hpp"
#include "tests/verification/wear/scenes.hpp"
#include "wear/asymptote/followed_asymptote.hpp"

namespace dovetail::wear {
namespace {

using Model = std::shared_ptr<const dynamics::CondensedModel>;

steady::Options settings() {
  return {.harmonics = 3, .samples = 128};
}

WornEnd worn(const steady::Joint& joint) {
  // The direct answer of every member: one decided by a history would differ from its neighbours by a node.
  const Asymptote found = asymptote(joint, 1.0, AsymptoteOptions{.arbitration = Arbitration::unsettled});
  return {.verdict = found.verdict,
          .status = found.status,
          .volume = found.worn_volume,
          .depth = found.depth,
          .solves = found.solves};
}

const SpreadRange& range_of(const Spread& spread, const std::string& source) {
  return *std::find_if(spread.ranges.begin(), spread.ranges.end(),
                       [&](const SpreadRange& range) { return range.source == source; });
}

class PunchSpread : public testing::Test {
 protected:
  steady::Joint joint_{std::make_shared<const dynamics::CondensedModel>(scenes::punch({.nodes = 41})), {}, settings()};
  steady::State unworn_ = paths::steady_state(joint_, 1.0);
  Spread spread_ = spread(joint_, worn(joint_), worn, &unworn_);
};

TEST_F(PunchSpread, ShapeDoesNotDependOnTheWearCoefficient) {
  const SpreadRange& range = range_of(spread_, "wear_coefficient");
  EXPECT_EQ(range.verdict, Verdict::asymptote);
  EXPECT_EQ(range.members, 2);
  // The states are the same to the solver's tolerance, 1e-9 of the forces, amplified by the release of nodes.
  EXPECT_LT(range.profile_change, 1e-6);
}

TEST_F(PunchSpread, LessFrictionAndMoreLoadWearMore) {
  // In partial slip of the punch the stick zone is c/a = sqrt(1 - Q/(mu P)): what slips grows with Q / mu.
  const auto volume = [&](const std::string& source, const std::string& change) {
    for (const SpreadMember& member : spread_.members)
      if (member.source == source && member.change == change) return member.end.volume;
    ADD_FAILURE() << source << change;
    return 0.0;
  };
  EXPECT_GT(volume("friction", "x 0.8"), volume("friction", "x 1.2"));
  EXPECT_GT(volume("load", "x 1.1"), volume("load", "x 0.9"));
  const SpreadRange& friction = range_of(spread_, "friction");
  EXPECT_EQ(friction.highest_volume, volume("friction", "x 0.8"));
  EXPECT_EQ(friction.lowest_volume, volume("friction", "x 1.2"));
  const SpreadRange& all = range_of(spread_, "combined");
  EXPECT_GT(all.highest_volume, friction.highest_volume);
  // Another corner of everything may leave the lowest volume of friction alone, to rounding.
  EXPECT_LE(all.lowest_volume, friction.lowest_volume * (1 + 1e-9));
  EXPECT_GT(all.highest_depth, friction.highest_depth);
}

TEST_F(PunchSpread, TriesResidualTractionsOfStuckNodes) {
  const SpreadRange& range = range_of(spread_, "residual_tractions");
  EXPECT_EQ(range.members, 4);
  EXPECT_LE(range.lowest_volume, spread_.nominal.volume);
  EXPECT_GE(range.highest_volume, spread_.nominal.volume);
}

TEST(Spread, FailedMembersAreCountedAndKept) {
  const Model model = std::make_shared<const dynamics::CondensedModel>(scenes::punch({.nodes = 21}));
  const double friction = model->contact().friction(0);
  const WornEnd nominal{.verdict = Verdict::asymptote, .volume = 1, .depth = Eigen::VectorXd::Ones(21)};
  const auto compute = [&](const steady::Joint& changed) {
    WornEnd end = nominal;
    if (changed.model->contact().friction(0) < friction) {
      end.verdict = Verdict::not_converged;
      end.status = Status::stalled;
    }
    return end;
  };
  const Spread result = spread({model, {}, settings()}, nominal, compute);
  const SpreadRange& range = range_of(result, "friction");
  EXPECT_EQ(range.verdict, Verdict::not_converged);
  EXPECT_EQ(range.members, 2);
  EXPECT_EQ(range.failed, 1);
  EXPECT_EQ(range_of(result, "load").verdict, Verdict::asymptote);
  EXPECT_EQ(range_of(result, "combined").verdict, Verdict::not_converged);
  EXPECT_TRUE(std::any_of(result.members.begin(), result.members.end(),
                          [](const SpreadMember& member) { return member.end.status == Status::stalled; }));
  SpreadOptions wrong;
  wrong.friction = 1;
  EXPECT_THROW((void)spread({model, {}, settings()}, nominal, compute, nullptr, wrong), InputError);
}

TEST(FollowedAsymptote, EndsAtTheResonanceOfItsOwnWornState) {
  const Model model = std::make_shared<const dynamics::CondensedModel>(scenes::rubbing_oscillator(0.3, 1.0, 0.5, 0.02));
  const paths::Resonance unworn = paths::resonance({model, {}, settings()}, 1.2);
  ASSERT_EQ(unworn.status, Status::converged);
  const FollowedAsymptote found = followed_asymptote({model, {}, settings()}, unworn.omega);
  ASSERT_EQ(found.held->verdict, Verdict::asymptote);
  ASSERT_EQ(found.asymptote.verdict, Verdict::asymptote);
  steady::Condition condition;
  condition.wear_depth = found.asymptote.depth;
  const paths::Resonance worn = paths::resonance({model, condition, settings()}, found.omegas.back());
  ASSERT_EQ(worn.status, Status::converged);
  // The loop ends at a change below 1e-7; the searches themselves are good to 1e-7.
  EXPECT_NEAR(worn.omega / found.omegas.back(), 1, 3e-7);
  EXPECT_GE(found.omegas.size(), 2U);
}

}  // namespace
}  // namespace dovetail::wear
