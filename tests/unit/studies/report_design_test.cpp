#include "studies/report/record/design_record.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace dovetail::report {
namespace {

/// A coarse mesh: the pieces must fit together, not be accurate.
optimizer::Scene coarse_scene() {
  optimizer::Scene scene;
  scene.mesh = {.flank_elements = 8, .fillet_fraction = 0.4, .bulk_size = 6e-3, .aerofoil_elements = 8};
  scene.solver.harmonics = 1;
  scene.solver.modes = 8;
  return scene;
}

struct Evaluated {
  optimizer::Scene scene = coarse_scene();
  optimizer::CandidateResult result = optimizer::SceneEvaluator(scene).evaluate(scene);
};

const Evaluated& evaluated() {
  static const Evaluated once;
  return once;
}

// Through springs on the trace there, between contact nodes here: a thousandth apart where the springs carry all.
TEST(DesignRecord, NodalDiametersHaveTheAsperitiesInThem) {
  optimizer::Scene scene = coarse_scene();
  scene.contact.normal_stiffness = scene.contact.tangential_stiffness = 1e10;
  optimizer::CandidateResult result =
      optimizer::SceneEvaluator(scene).evaluate(scene, {.bars = false, .until = optimizer::Stage::unworn});
  ASSERT_EQ(result.evaluation.status, "converged");
  const DesignRecord record = make_design_record(
      scene, result, {.curve_points = 0, .nodal_diameter_modes = 2, .history_steps = 0, .fields = false});
  const double glued = record.responses.at("glued_frequency_hz");
  EXPECT_LT(glued, 0.8 * evaluated().result.evaluation.responses.at("glued_frequency_hz"));
  EXPECT_NEAR(record.nodal_diameters.frequency_hz[0] / glued, 1, 1e-3);
}

TEST(DesignRecord, AgreesWithTheEvaluation) {
  const Evaluated& design = evaluated();
  ASSERT_EQ(design.result.evaluation.status, "converged");
  const DesignRecord record = make_design_record(design.scene, design.result,
                                                 {.curve_points = 11, .nodal_diameter_modes = 2, .history_steps = 3});
  EXPECT_EQ(record.responses, design.result.evaluation.responses);

  // The middle point of each curve is its resonance.
  ASSERT_EQ(record.unworn.amplitude_m.size(), 11U);
  EXPECT_NEAR(record.unworn.amplitude_m[5] / record.responses.at("peak_amplitude_m"), 1, 1e-6);
  EXPECT_NEAR(record.unworn.frequency_hz[5] / record.responses.at("resonance_hz"), 1, 1e-12);
  ASSERT_EQ(record.worn.amplitude_m.size(), 11U);
  EXPECT_NEAR(record.worn.amplitude_m[5] / record.responses.at("worn_peak_amplitude_m"), 1, 1e-6);
  for (const ResponseCurve* curve : {&record.unworn, &record.worn, &record.glued}) {
    EXPECT_EQ(std::max_element(curve->amplitude_m.begin(), curve->amplitude_m.end()) - curve->amplitude_m.begin(), 5);
    EXPECT_TRUE(std::is_sorted(curve->frequency_hz.begin(), curve->frequency_hz.end()));
  }

  // Friction only takes energy out: the glued peak is the highest, and lies highest.
  EXPECT_GT(record.glued.amplitude_m[5], record.unworn.amplitude_m[5]);
  EXPECT_GT(record.glued.frequency_hz[5], record.unworn.frequency_hz[5]);

  // Nodal diameters 0 .. 23 of 47 sectors; the first mode of diameter 0 is the glued frequency of the reduced model,
  // whose own estimate of its error is far below 1e-4.
  ASSERT_EQ(record.nodal_diameters.nodal_diameter.size(), 24U);
  EXPECT_NEAR(record.nodal_diameters.frequency_hz[0] / record.responses.at("glued_frequency_hz"), 1, 1e-4);

  // The flanks carry the blade's pull m Omega^2 r, its centre of gravity r between 0.24 m (root) and 0.36 m (tip):
  // N (sin a + f cos a) = pull with a friction f anywhere between -mu and mu.
  const ContactRecord& contact = record.contact;
  const double normal =
      std::inner_product(contact.area_m2.begin(), contact.area_m2.end(), contact.preload_pressure_pa.begin(), 0.0);
  const double pull = record.responses.at("mass_kg") * std::pow(design.scene.loading.speed, 2);
  const double a = design.scene.geometry.flank("left").angle, mu = design.scene.contact.friction;
  EXPECT_GT(normal, 0.24 * pull / (std::sin(a) + mu * std::cos(a)));
  EXPECT_LT(normal, 0.36 * pull / (std::sin(a) - mu * std::cos(a)));

  EXPECT_EQ(record.fields.von_mises_pa.size(), static_cast<std::size_t>(record.fields.mesh.node_count()));
  ASSERT_TRUE(record.history);
  EXPECT_EQ(record.history->cycles.front(), 0);
  EXPECT_TRUE(std::is_sorted(record.history->worn_volume_m3.begin(), record.history->worn_volume_m3.end()));
  EXPECT_EQ(record.history->profile_depth_m.size(), record.history->profile_states.size() * contact.flank.size());
}

TEST(DesignRecord, SaysWhyADesignHasNoCurves) {
  optimizer::Scene scene = coarse_scene();
  const optimizer::SceneEvaluator evaluator(scene);
  scene.limits.minimum_wall = 0.05;
  const optimizer::CandidateResult result = evaluator.evaluate(scene);
  ASSERT_EQ(result.evaluation.status, "infeasible");
  const DesignRecord record = make_design_record(scene, result);
  EXPECT_EQ(record.status, "infeasible");
  EXPECT_EQ(record.profile.blade.size(), 28U);
  EXPECT_TRUE(record.unworn.frequency_hz.empty());
  // The rules that it breaks, and what follows.
  ASSERT_EQ(record.notes.size(), result.evaluation.messages.size() + 1);
  EXPECT_NE(record.notes.back().find("infeasible"), std::string::npos);
}

}  // namespace
}  // namespace dovetail::report
