#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "empty_model.hpp"
#include "paths/steady_state.hpp"
#include "scenes.hpp"
#include "wear/asymptote/asymptote.hpp"
#include "wear/asymptote/depth_scale.hpp"
#include "wear/history/history.hpp"
#include "wear/measures.hpp"

// A mass pressed on a flat by a constant force slides for ever: its pressure does not change as it wears, and the rate
// is k_w p times the path per cycle from the first cycle on.

namespace dovetail::wear {
namespace {

using Model = std::shared_ptr<const dynamics::CondensedModel>;

constexpr double kFriction = 0.4, kLoad = 1.0, kArea = 0.5, kWear = 1e-3, kOmega = 0.8;

reduction::ReducedModel with_contact(reduction::ReducedModel model) {
  model.contact.friction.setConstant(kFriction);
  model.contact.wear_coefficient.setConstant(kWear);
  model.contact.area.setConstant(kArea);
  return model;
}

// Den Hartog's oscillator, m = k = F_0 = 1, b = 0.8, x_f = 0.4: x_0 = 2.501787881002, there and back.
Model in_plane() {
  return std::make_shared<const dynamics::CondensedModel>(
      with_contact(scenes::den_hartog(kFriction, kLoad, 0.0, kWear)));
}
constexpr double kPlanePath = 4 * 2.501787881002;

// The same mass free in two directions under a rotating force. It goes round a circle whose velocity turns steadily, so
// friction is one harmonic a quarter of a turn behind: |F|^2 = ((k - m w^2) R)^2 + (mu N)^2.
Model in_space() {
  reduction::ReducedModel model = scenes::empty_model(3, 1, 1, 2);
  model.stiffness.diagonal() << 0.0, 1.0, 1.0;
  model.mass.diagonal() << 0.0, 1.0, 1.0;
  model.static_force[0] = kLoad;
  model.cosine_force(0, 1) = 1.0;
  model.sine_force(0, 2) = 1.0;
  model.output_vectors(0, 1) = 1.0;
  return std::make_shared<const dynamics::CondensedModel>(with_contact(std::move(model)));
}
double space_path() {
  const double radius = std::sqrt(1 - kFriction * kFriction * kLoad * kLoad) / (1 - kOmega * kOmega);
  return 2 * std::numbers::pi * radius;
}

double closed_form(double path) {
  return kWear * kLoad / kArea * path;
}

struct Slider {
  Model model;
  steady::Options steady;
};

class Sliding : public testing::TestWithParam<bool> {
 protected:
  static Slider slider() {
    if (GetParam()) return {.model = in_space(), .steady = {.harmonics = 3, .samples = 512}};
    return {.model = in_plane(), .steady = {.harmonics = 5, .samples = 320}};
  }
};

double steady_rate(const Model& model, const steady::Options& steady) {
  const Asymptote worn = asymptote({model, {}, steady}, kOmega);
  EXPECT_EQ(worn.verdict, Verdict::no_asymptote) << dovetail::to_string(worn.status);
  return worn.rate.size() == 1 ? worn.rate[0] : 0.0;
}

// Mass on the contact: truncation at H harmonics costs O(1/H), so the error falls threefold from H = 21, where it is
// some 4 %, to 63. What is left after extrapolating is of second order, (1/63)^2 of the path and a small factor.
TEST(DeadLoad, WearsAtTheRateOfDenHartogsPath) {
  const double coarse = steady_rate(in_plane(), {.harmonics = 21, .samples = 1344});
  const double fine = steady_rate(in_plane(), {.harmonics = 63, .samples = 4032});
  const double rate = closed_form(kPlanePath);
  EXPECT_NEAR((coarse - rate) / (fine - rate), 3.0, 0.3);
  EXPECT_NEAR(fine + 0.5 * (fine - coarse), rate, 1e-3 * rate);
}

// One harmonic is exact and the march of second order: (2 pi / N)^2 = 1.5e-4 at N = 512.
TEST(DeadLoad, WearsAtTheRateOfTheCircle) {
  const double rate = closed_form(space_path());
  EXPECT_NEAR(steady_rate(in_space(), {.harmonics = 3, .samples = 512}), rate, 1.5e-4 * rate);
}

TEST_P(Sliding, IsConfirmedByTheHistory) {
  const Slider scene = slider();
  const Asymptote worn = asymptote({scene.model, {}, scene.steady}, kOmega);
  EXPECT_EQ(worn.verdict, Verdict::no_asymptote) << dovetail::to_string(worn.status);
  EXPECT_EQ(worn.status, Status::converged);
  EXPECT_TRUE(worn.confirmed_by_history);
  // Failed ladders of attempts, step after step, would be hundreds.
  EXPECT_LE(worn.solves, 60);
}

TEST_P(Sliding, HasAFiniteScaleOfDepth) {
  const Slider scene = slider();
  const DepthScale scale = depth_scale({scene.model, {}, scene.steady}, kOmega, kFromModel);
  EXPECT_EQ(scale.status, Status::converged);
  EXPECT_FALSE(scale.released);
  EXPECT_TRUE(std::isfinite(scale.depth));
  EXPECT_GT(scale.depth, 0.0);
}

// Every state is solved to 1e-9, and its rate is the first one's.
TEST_P(Sliding, GivesHistoriesASteadyRate) {
  const Slider scene = slider();
  const steady::State unworn = paths::steady_state({scene.model, {}, scene.steady}, kOmega);
  ASSERT_EQ(unworn.status, Status::converged);
  const double rate = unworn.wear_rate[0];
  const double increment = 0.01 * largest_penetration(*scene.model, unworn);
  const History run = history({scene.model, {}, scene.steady}, {.omega = kOmega}, {.increment = increment});
  EXPECT_EQ(run.end, HistoryEnd::steady_rate) << to_string(run.end);
  EXPECT_EQ(run.status, Status::converged);
  ASSERT_EQ(run.final_rate.size(), 1);
  EXPECT_NEAR(run.final_rate[0], rate, 1e-7 * rate);
  // Cycles that were asked for are done.
  const History some =
      history({scene.model, {}, scene.steady}, {.omega = kOmega}, {.increment = increment, .cycles = 10.0});
  EXPECT_EQ(some.end, HistoryEnd::cycles);
  EXPECT_NEAR(some.final_depth[0], 10.0 * rate, 1e-7 * 10.0 * rate);
}

INSTANTIATE_TEST_SUITE_P(DeadLoad, Sliding, testing::Values(false, true),
                         [](const auto& scene) { return scene.param ? "space" : "plane"; });

}  // namespace
}  // namespace dovetail::wear
