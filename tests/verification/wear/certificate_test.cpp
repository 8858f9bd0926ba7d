#include "wear/asymptote/certificate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "paths/steady_state.hpp"
#include "verdict_scenes.hpp"
#include "wear/asymptote/asymptote.hpp"

namespace dovetail::wear {
namespace {

using scenes::Family;

std::shared_ptr<const dynamics::CondensedModel> condensed(Family family, unsigned number) {
  return std::make_shared<const dynamics::CondensedModel>(scenes::verdict_model(family, number));
}

AsymptoteOptions options() {
  AsymptoteOptions options;
  options.rate_threshold = 0.0;
  return options;
}

TEST(Certificate, HoldsAtFinerSettings) {
  for (const Family family : {Family::crowned, Family::punch, Family::space}) {
    const Asymptote worn = asymptote({condensed(family, 1), {}, scenes::kVerdictSettings}, 1.0, options());
    ASSERT_EQ(worn.verdict, Verdict::asymptote);
    EXPECT_EQ(worn.finer.harmonics, 7);
    EXPECT_EQ(worn.finer.samples, 128);
    EXPECT_TRUE(worn.holds_finer);
    // The worn state sticks, and a stuck state of a quasi-static model has one harmonic at any settings.
    EXPECT_LT(worn.finer.remaining, 1e-6);
    EXPECT_LE(worn.finer.jacobians, 2);
  }
}

// Nodes come to rest in contact that lift off at times: what three harmonics keep from slipping, seven let slip.
TEST(Certificate, ThatFailsAtFinerSettingsIsADoubt) {
  const auto model = condensed(Family::coupled, 1);
  const Asymptote worn = asymptote({model, {}, scenes::kVerdictSettings}, 1.0, options());
  ASSERT_EQ(worn.verdict, Verdict::asymptote);
  EXPECT_LT(worn.certificate, 1e-3);
  EXPECT_GT(worn.finer.remaining, 1e-2);
  EXPECT_FALSE(worn.holds_finer);
  EXPECT_EQ(worn.doubt, Doubt::finer_settings);
  // The same from a steady state of its own.
  const steady::State separate =
      paths::steady_state({model, {.wear_depth = worn.depth}, finer_settings(scenes::kVerdictSettings)}, 1.0);
  ASSERT_EQ(separate.status, Status::converged);
  EXPECT_NEAR(worn.finer.remaining, separate.wear_rate.maxCoeff() / worn.unworn_rate.maxCoeff(),
              1e-5 * worn.finer.remaining);
}

TEST(Certificate, IsNotCheckedWhenNotAsked) {
  AsymptoteOptions coarse = options();
  coarse.certify_finer = false;
  const Asymptote worn = asymptote({condensed(Family::coupled, 1), {}, scenes::kVerdictSettings}, 1.0, coarse);
  EXPECT_EQ(worn.finer.harmonics, 0);
  EXPECT_NE(worn.doubt, Doubt::finer_settings);
}

TEST(Certificate, SaysWhatCouldNotBeSolved) {
  const auto model = condensed(Family::crowned, 1);
  const steady::State unworn = paths::steady_state({model, {}, scenes::kVerdictSettings}, 1.0);
  ASSERT_EQ(unworn.status, Status::converged);
  steady::Options hasty = finer_settings(scenes::kVerdictSettings);
  hasty.max_iterations = 1;
  hasty.penalty_cascade = false;
  hasty.max_rescue_iterations = 0;
  const Certificate found = certificate({model, {}, hasty}, unworn.wear_rate.maxCoeff(), unworn);
  EXPECT_NE(found.status, Status::converged);
  EXPECT_TRUE(std::isnan(found.remaining));
}

// The paraboloid, its load and a circular orbit are the same turned by a right angle: so is the wear.
TEST(SpacePunch, WearsAlikeBothWaysOnACircle) {
  const scenes::SpacePunch data{.side = 7, .first_load = 0.2, .second_load = 0.2};
  const auto model = std::make_shared<const dynamics::CondensedModel>(scenes::space_punch(data));
  const Asymptote worn = asymptote({model, {}, scenes::kVerdictSettings}, 1.0, options());
  ASSERT_EQ(worn.verdict, Verdict::asymptote);
  ASSERT_GT(worn.largest_depth, 0.0);
  for (Eigen::Index i = 0; i < data.side; ++i)
    for (Eigen::Index j = 0; j < data.side; ++j)
      // Residuals of 1e-9 of the excitation over the stiffness of a node.
      EXPECT_NEAR(worn.depth[i + data.side * j], worn.depth[j + data.side * i], 1e-6 * worn.largest_depth);
}

}  // namespace
}  // namespace dovetail::wear
