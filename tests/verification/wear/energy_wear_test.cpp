// Wear by dissipated energy.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "paths/steady_state.hpp"
#include "scenes.hpp"
#include "wear/asymptote/asymptote.hpp"
#include "wear/history/history.hpp"

namespace dovetail::wear {
namespace {

steady::Joint joint_of(const reduction::ReducedModel& model, int harmonics, int samples) {
  return {std::make_shared<const dynamics::CondensedModel>(model), {}, {.harmonics = harmonics, .samples = samples}};
}

TEST(EnergyWear, IsArchardsWithoutAThreshold) {
  const reduction::ReducedModel archard = scenes::punch({.nodes = 41});
  reduction::ReducedModel energy = archard;
  energy.contact.wear_law = "energy";
  energy.contact.wear_coefficient = archard.contact.wear_coefficient.cwiseQuotient(archard.contact.friction);
  const Asymptote one = asymptote(joint_of(archard, 3, 128), 1.0), other = asymptote(joint_of(energy, 3, 128), 1.0);
  ASSERT_EQ(one.verdict, Verdict::asymptote);
  ASSERT_EQ(other.verdict, Verdict::asymptote);
  EXPECT_EQ(one.doubt, other.doubt);
  EXPECT_LT((one.unworn_rate - other.unworn_rate).cwiseAbs().maxCoeff(), 1e-12 * one.unworn_rate.maxCoeff());
  EXPECT_LT((one.depth - other.depth).cwiseAbs().maxCoeff(), 1e-9 * one.largest_depth);
}

// Den Hartog's oscillator of b = 0.8 slides all the time with the amplitude sqrt(V^2 - (mu p U)^2), V = 1 / (1 - b^2)
// and U = sin(pi/b) / (b (1 + cos(pi/b))), and dissipates 4 mu p times that. It wears until this is the threshold.
TEST(EnergyWear, EndsWhereTheEnergyIsTheThreshold) {
  constexpr double kFriction = 0.4, kStiffness = 2, kEnd = 0.5, b = 0.8;
  const double v = 1 / (1 - b * b), u = std::sin(M_PI / b) / (b * (1 + std::cos(M_PI / b)));
  reduction::ReducedModel model = scenes::den_hartog(kFriction, 1.0, kStiffness, 1e-3);
  model.contact.wear_law = "energy";
  model.contact.wear_threshold = Eigen::VectorXd::Constant(
      1, 4 * kFriction * kEnd * std::sqrt(v * v - std::pow(kFriction * kEnd * u, 2)) / model.contact.area(0));
  const double depth = (1 - kEnd) / kStiffness;
  // The mass rubs directly: truncation at H harmonics costs O(1/H).
  const auto found = [&](int harmonics) {
    const Asymptote end = asymptote(joint_of(model, harmonics, 64 * harmonics), b, {.rate_threshold = 0.0});
    EXPECT_EQ(end.verdict, Verdict::asymptote) << to_string(end.status);
    EXPECT_EQ(end.decided_by, FoundBy::history);
    return end.largest_depth;
  };
  const double coarse = found(7), fine = found(21);
  EXPECT_NEAR(fine, depth, 0.02 * depth);
  EXPECT_NEAR(fine + 0.5 * (fine - coarse), depth, 2e-3 * depth);
}

// At rest a node that has worn dissipates its threshold or carries nothing, and no other dissipates more.
TEST(EnergyWear, LeavesNodesAtRestInSlip) {
  reduction::ReducedModel model = scenes::punch({.nodes = 41});
  model.contact.wear_law = "energy";
  const steady::Joint plain = joint_of(model, 3, 128);
  const steady::State unworn = paths::steady_state(plain, 1.0);
  double largest = 0;
  for (std::size_t i = 0; i < unworn.nodes.size(); ++i)
    largest = std::max(largest, unworn.nodes[i].dissipated_energy / model.contact.area(static_cast<Eigen::Index>(i)));
  const double threshold = 0.3 * largest;
  model.contact.wear_threshold = Eigen::VectorXd::Constant(41, threshold);
  const steady::Joint joint = joint_of(model, 3, 128);
  const Asymptote end = asymptote(joint, 1.0, {.rate_threshold = 0.0});
  ASSERT_EQ(end.verdict, Verdict::asymptote) << to_string(end.status);
  EXPECT_EQ(end.doubt, Doubt::threshold);
  EXPECT_TRUE(end.confirmed_by_history);
  int slipping = 0;
  for (Eigen::Index i = 0; i < 41; ++i) {
    const steady::NodeSummary& node = end.steady.nodes[static_cast<std::size_t>(i)];
    const double energy = node.dissipated_energy / model.contact.area(i);
    EXPECT_LE(energy, 1.01 * threshold) << i;
    if (end.depth[i] < 0.02 * end.largest_depth || !node.carries_load) continue;
    EXPECT_NEAR(energy, threshold, 0.01 * threshold) << i;
    ++slipping;
  }
  EXPECT_GT(slipping, 2);
  // Wear without the threshold goes further.
  EXPECT_LT(end.worn_volume, asymptote(plain, 1.0).worn_volume);
  // Cycle by cycle it ends there, too: steps overshoot the rest by an amount of first order in their increment, 5 % of
  // the volume at one of 1 %.
  const History run =
      history(joint, {.omega = 1.0}, {.increment = 0.0025 * end.largest_depth, .steps = 2000, .rate_threshold = 0.0});
  ASSERT_EQ(run.end, HistoryEnd::worn_out);
  EXPECT_FALSE(run.finished);
  EXPECT_NEAR(run.final_volume, end.worn_volume, 0.015 * end.worn_volume);
}

TEST(EnergyWear, OfAnUnknownLawIsRefused) {
  reduction::ReducedModel model = scenes::punch({.nodes = 21});
  model.contact.wear_law = "gravity";
  EXPECT_THROW(joint_of(model, 3, 128), InputError);
}

}  // namespace
}  // namespace dovetail::wear
