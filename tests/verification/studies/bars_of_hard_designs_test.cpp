// Error bars of single designs around the quickstart on which they are easily too small, or where none may be given.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "optimizer/bars/other_meshes.hpp"
#include "quickstart_designs.hpp"

namespace dovetail::studies {
namespace {

// The history ends with a fifth of the direct volume; on 64 edges with 11 harmonics and 256 samples the worn amplitude
// is 7.5533 mm, nearer to that of the direct state.
TEST(BarsOfHardDesigns, TheBarOfTheWornAmplitudeReachesToTheOtherState) {
  const optimizer::Evaluation evaluation =
      evaluated({{"contact.tangential_stiffness_n_per_m3", 3e13}}, true).evaluation;
  ASSERT_TRUE(evaluation.converged()) << evaluation.status;
  EXPECT_EQ(evaluation.model.at("wear_decided_by_history"), 1);
  EXPECT_NEAR(evaluation.responses.at("worn_peak_amplitude_m"), 7.5533e-3,
              evaluation.error_estimates.at("worn_peak_amplitude_m"));
  EXPECT_GT(evaluation.error_sources.at("worn_peak_amplitude_m").at("history"), 5e-6);
}

// On 64 edges with 11 harmonics and 256 samples 3.07e-12 m^3. The direct method, which knows of no rest in slip, says
// 7.1e-11: that is no bar.
TEST(BarsOfHardDesigns, TheDirectStateIsNoBarUnderAnEnergyThreshold) {
  optimizer::Scene scene = load_study(QUICKSTART, {}).scene;
  scene.contact.wear_law = "energy";
  scene.contact.wear.at("energy").threshold = 60;
  const optimizer::Evaluation evaluation = optimizer::SceneEvaluator(scene).evaluate(scene, {.bars = true}).evaluation;
  ASSERT_TRUE(evaluation.converged()) << evaluation.status;
  const double volume = evaluation.responses.at("asymptotic_wear_volume_m3");
  const double bar = evaluation.error_estimates.at("asymptotic_wear_volume_m3");
  EXPECT_NEAR(volume, 1.58e-11, bar);
  EXPECT_LT(bar, volume);
}

// Zones that grow while the resonance is followed grow on some meshes and not on others; volumes of 24 to 80 edges per
// flank are within 9 % of 4.28e-10 m^3, about that of 64 to 128 (where the finest two do not settle), and were up
// to 5.2e-10 where cells did not end with them.
TEST(BarsOfHardDesigns, WhereZonesEndWhoseResonanceIsFollowedIsInTheBar) {
  constexpr double kFine = 4.28e-10;
  optimizer::Scene scene = load_study(QUICKSTART, {}).scene;
  scene.loading.follow = wear::Follow::resonance;
  const optimizer::CandidateResult result =
      optimizer::SceneEvaluator(scene, std::vector<std::string>{"asymptotic_wear_volume_m3"})
          .evaluate(scene, {.bars = true, .history = false});
  const auto& parts = result.evaluation.error_sources.at("asymptotic_wear_volume_m3");
  double bar = 0;
  for (const auto& [source, part] : parts) bar += source == "history" ? 0 : part;
  const double volume = result.evaluation.responses.at("asymptotic_wear_volume_m3");
  EXPECT_LT(std::abs(volume - kFine), bar);
  EXPECT_GT(parts.at("zone_ends"), 0.05 * volume);
  EXPECT_LT(bar, 0.3 * volume);
}

// A radius of 0.3 mm takes the peak off over 0.8 um: 128 edges say 832 MPa, 24 say 340. With one of 0.05 mm
// 24 edges say 399, 36 say 460 and 128 say 1054 MPa: the change from mesh to mesh does not tell how far it is.
TEST(BarsOfHardDesigns, APeakThatTheMeshDoesNotResolveHasNoBar) {
  for (const double radius : {0.3, 0.05}) {
    const optimizer::Evaluation evaluation = evaluated({{"geometry.flank_edge_radius_mm", radius}}, true).evaluation;
    ASSERT_TRUE(evaluation.converged()) << evaluation.status;
    EXPECT_EQ(evaluation.unbounded, std::vector<std::string>{"contact_pressure_max_pa"}) << radius;
    EXPECT_FALSE(evaluation.error_estimates.contains("contact_pressure_max_pa")) << radius;
  }
}

// Rough flanks with a relief: 24 edges say 169.6 MPa with a bar of 79.2 MPa if what meshes and nodes say of it were
// enough, 96 edges 262 and 160 edges 258.
TEST(BarsOfHardDesigns, APeakAtAReliefOfRoughFlanksHasNoBar) {
  const optimizer::Evaluation evaluation = evaluated({{"contact.normal_stiffness_n_per_m3", 1e15},
                                                      {"geometry.relief_length_mm", 1},
                                                      {"geometry.relief_depth_um", 30},
                                                      {"loading.tip_force_n", 0.2},
                                                      {"loading.damping_ratio", 0.003}},
                                                     true)
                                               .evaluation;
  ASSERT_TRUE(evaluation.converged()) << evaluation.status;
  EXPECT_EQ(evaluation.unbounded, std::vector<std::string>{"contact_pressure_max_pa"});
}

// Joints without wear, whose ends begin to slip in zones of which only 96 edges see something: how much wears there is
// known by its bar, how deep, and what it does to the resonance. On rough flanks it wears as deep as the pressure has
// compressed their asperities.
TEST(BarsOfHardDesigns, WhatIsTooNarrowToBeSeenIsInTheBarsOfAJointWithoutWear) {
  struct Case {
    Changes changes;
    double volume, depth, drift;  // on 96 edges
  };
  for (const auto& [changes, volume, depth, drift] :
       {Case{{{"loading.tip_force_n", 0.37}}, 3.2118e-14, 7.694e-8, -1.0133e-5},
        Case{{{"loading.tip_force_n", 1.285},
              {"contact.normal_stiffness_n_per_m3", 5e13},
              {"contact.tangential_stiffness_n_per_m3", 4e13}},
             3.0509e-12,
             2.7965e-6,
             -1.7808e-5}}) {
    const optimizer::Evaluation evaluation = evaluated(changes, true).evaluation;
    ASSERT_TRUE(evaluation.converged()) << evaluation.status;
    const std::map<std::string, double>& bars = evaluation.error_estimates;
    ASSERT_EQ(evaluation.responses.at("asymptotic_wear_volume_m3"), 0);
    EXPECT_GT(bars.at("asymptotic_wear_volume_m3"), volume);
    EXPECT_GT(bars.at("asymptotic_wear_depth_max_m"), depth);
    EXPECT_GT(bars.at("resonance_drift"), -drift);
    EXPECT_GE(bars.at("worn_peak_amplitude_m"), bars.at("peak_amplitude_m"));
    EXPECT_GE(bars.at("worn_resonance_hz"), bars.at("resonance_hz"));
  }
}

// 160 edges say 157.7, 473.9 and 243.6 MPa. In the second, on hollow flanks, a mesh 1.5 times as fine and nodes 1.5
// times as long agree to half the error: what the node is long beside the rounding tells. In the third the flanks are
// rough.
TEST(BarsOfHardDesigns, APeakThatTheMeshResolvesHasABarThatHolds) {
  for (const auto& [peak, changes] : {std::pair{157.7e6, Changes{{"geometry.flank_edge_radius_mm", 100}}},
                                      {473.9e6,
                                       {{"geometry.flank_edge_radius_mm", 8},
                                        {"geometry.flank_mismatch_um", 20},
                                        {"geometry.flank_crown_um", -2.5},
                                        {"geometry.flank_angle_deg", 47}}},
                                      {243.6e6,
                                       {{"contact.normal_stiffness_n_per_m3", 5e13},
                                        {"geometry.flank_mismatch_um", 20},
                                        {"geometry.flank_crown_um", -2.5},
                                        {"geometry.flank_angle_deg", 47}}}}) {
    Changes finer = changes;
    finer.emplace_back("mesh.flank_elements", 48);
    const optimizer::Purpose unworn{.until = optimizer::Stage::unworn};
    const optimizer::Evaluation evaluation = evaluated(finer, unworn, {"contact_pressure_max_pa"}).evaluation;
    ASSERT_TRUE(evaluation.converged()) << evaluation.status;
    EXPECT_TRUE(evaluation.unbounded.empty());
    const double bar = evaluation.error_estimates.at("contact_pressure_max_pa");
    EXPECT_NEAR(evaluation.responses.at("contact_pressure_max_pa"), peak, bar);
    EXPECT_LT(bar, 0.09 * peak);
    if (changes.size() > 1) continue;
    // Coarser meshes, which a study that does not name the peak asks alone, hardly resolve it: a large bar, or none.
    const optimizer::Evaluation aside = evaluated(finer, unworn).evaluation;
    const auto large = aside.error_estimates.find("contact_pressure_max_pa");
    if (large == aside.error_estimates.end())
      EXPECT_THAT(aside.unbounded, ::testing::Contains("contact_pressure_max_pa"));
    else
      EXPECT_NEAR(aside.responses.at("contact_pressure_max_pa"), peak, large->second);
  }
}

// Under a thousandth of a newton everything sticks.
TEST(BarsOfHardDesigns, UnderHardlyAnyForceTheAmplitudeIsKnown) {
  const optimizer::Evaluation evaluation = evaluated({{"loading.tip_force_n", 1e-3}}, true).evaluation;
  ASSERT_TRUE(evaluation.converged()) << evaluation.status;
  EXPECT_LT(evaluation.error_estimates.at("peak_amplitude_m"), 0.01 * evaluation.responses.at("peak_amplitude_m"));
}

// What 54 edges and nodes of the same number say of this one agrees with 36 to 0.03 %, by accident: 96 edges, all other
// elements half as large and 15 harmonics say 0.0513 mm^3, 2.9 % more. Nodes 1.5 times as long tell.
TEST(BarsOfHardDesigns, MeshesThatAgreeByAccidentAreNoBar) {
  const optimizer::Evaluation evaluation = evaluated({{"geometry.neck_width_mm", 9.5},
                                                      {"geometry.neck_fillet_radius_mm", 2.0036783000222385},
                                                      {"geometry.flank_angle_deg", 47.02909767125675},
                                                      {"geometry.flank_length_mm", 5.39895725225324},
                                                      {"geometry.flank_mismatch_um", 15.163268194291959},
                                                      {"geometry.flank_crown_um", 3.1554181173960387},
                                                      {"mesh.flank_elements", 36}},
                                                     true)
                                               .evaluation;
  ASSERT_TRUE(evaluation.converged()) << evaluation.status;
  const double bar = evaluation.error_estimates.at("asymptotic_wear_volume_m3");
  EXPECT_NEAR(evaluation.responses.at("asymptotic_wear_volume_m3"), 5.13e-11, bar);
  EXPECT_LT(bar, 0.1 * 5.13e-11);
}

// The finer companion of the bars stays within the ranges that keys have.
TEST(BarsOfHardDesigns, BarsOfAMeshNextToTheFinestThereIs) {
  optimizer::Scene scene = load_study(QUICKSTART, {}).scene;
  for (const auto& [key, value] : {std::pair{"mesh.blend_fraction", 0.07}, {"mesh.fillet_fraction", 0.05}})
    optimizer::set_parameter(scene, key, value);
  const optimizer::Scene finest = optimizer::resized(scene, 1 / 1.5);
  EXPECT_EQ(optimizer::parameter(finest, "mesh.blend_fraction"),
            optimizer::find_parameter("mesh.blend_fraction")->range.lower);
  EXPECT_EQ(optimizer::parameter(finest, "mesh.flank_elements"), 36);
  EXPECT_NO_THROW(optimizer::OtherMeshes{scene});
}

// Enough for the answer itself, not for every companion of its error bars.
TEST(BarsOfHardDesigns, WithoutItsErrorBarsAnAnswerIsNotConverged) {
  const optimizer::Evaluation evaluation = evaluated({{"loading.tip_force_n", 0.5},
                                                      {"geometry.flank_mismatch_um", 10},
                                                      {"solver.harmonics", 2},
                                                      {"solver.max_jacobians", 3}},
                                                     true)
                                               .evaluation;
  EXPECT_EQ(evaluation.status, "error_estimates: budget_spent");
  EXPECT_TRUE(evaluation.responses.contains("worn_peak_amplitude_m"));
  EXPECT_FALSE(evaluation.error_estimates.contains("worn_peak_amplitude_m"));
}

}  // namespace
}  // namespace dovetail::studies
