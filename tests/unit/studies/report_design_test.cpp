#include "studies/report/record/design_record.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "paths/frequency_response.hpp"

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

  // The highest point of each curve is its resonance.
  const auto peak = [](const ResponseCurve& curve) {
    const auto highest = std::ranges::max_element(curve.amplitude_m) - curve.amplitude_m.begin();
    return std::pair(curve.frequency_hz[static_cast<std::size_t>(highest)],
                     *std::ranges::max_element(curve.amplitude_m));
  };
  EXPECT_NEAR(peak(record.unworn).second / record.responses.at("peak_amplitude_m"), 1, 1e-6);
  EXPECT_NEAR(peak(record.unworn).first / record.responses.at("resonance_hz"), 1, 1e-12);
  EXPECT_NEAR(peak(record.worn).second / record.responses.at("worn_peak_amplitude_m"), 1, 1e-6);
  EXPECT_EQ(record.glued.amplitude_m.size(), 11U);
  for (const ResponseCurve* curve : {&record.unworn, &record.worn, &record.glued})
    EXPECT_TRUE(std::ranges::is_sorted(curve->frequency_hz));

  // Friction only takes energy out: the glued peak is the highest, and lies highest.
  EXPECT_GT(peak(record.glued).second, peak(record.unworn).second);
  EXPECT_GT(peak(record.glued).first, peak(record.unworn).first);

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

// Shapes of the full model whose energies are those of their frequencies, and contact nodes where their cells are.
TEST(DesignRecord, HasModesAndContactNodesOnTheMesh) {
  const Evaluated& design = evaluated();
  const DesignRecord record =
      make_design_record(design.scene, design.result,
                         {.curve_points = 0, .nodal_diameter_modes = 0, .history_steps = 0, .mode_shapes = 3});
  const FieldRecord& fields = record.fields;
  const Eigen::SparseMatrix<double> stiffness = design.result.model.matrices.stiffness();
  const Eigen::SparseMatrix<double>& mass = design.result.model.matrices.shared->system.full.mass;
  ASSERT_EQ(fields.mode_frequency_hz.size(), 3U);
  const Eigen::Index size = fields.mesh.nodes.size();
  ASSERT_EQ(fields.mode_shapes.size(), 3 * static_cast<std::size_t>(size));
  for (Eigen::Index m = 0; m < 3; ++m) {
    const Eigen::Map<const Eigen::VectorXd> shape(fields.mode_shapes.data() + m * size, size);
    const double omega = 2 * std::numbers::pi * fields.mode_frequency_hz[static_cast<std::size_t>(m)];
    // Reduced modes are those of the full model but for the modes left out: their frequencies err by 1e-4 at most here.
    EXPECT_NEAR(shape.dot(stiffness * shape) / (omega * omega * shape.dot(mass * shape)), 1, 1e-3) << m;
    EXPECT_NEAR(shape.reshaped(2, size / 2).colwise().norm().maxCoeff(), 1, 1e-12);
  }
  ASSERT_EQ(fields.flank_nodes.size(), fields.flank_cells.size());
  ASSERT_FALSE(fields.flank_nodes.empty());
  const ContactRecord& contact = record.contact;
  std::vector<double> longest(contact.flank.size(), 0.0);
  for (std::size_t i = 0; i < contact.flank.size(); ++i)
    longest[i] = contact.area_m2[i] / design.scene.geometry.slot_length;
  for (std::size_t k = 0; k < fields.flank_nodes.size(); ++k) {
    const auto cell = static_cast<std::size_t>(fields.flank_cells[k]);
    const Eigen::Vector2d at = fields.mesh.nodes.col(fields.flank_nodes[k]);
    EXPECT_LE((at - Eigen::Vector2d(contact.x_m[cell], contact.y_m[cell])).norm(), 0.5 * longest[cell] * (1 + 1e-6));
  }
  EXPECT_EQ(contact.slip_m_per_cycle.size(), contact.flank.size());
}

// Fewer points than may be computed, and lines between them that show the rest.
TEST(DesignRecord, CurvesHavePointsWhereTheyBend) {
  const Evaluated& design = evaluated();
  const DesignRecord record =
      make_design_record(design.scene, design.result, {.nodal_diameter_modes = 0, .history_steps = 0, .fields = false});
  const ResponseCurve& drawn = record.unworn;
  EXPECT_LT(drawn.frequency_hz.size(), 45U);
  EXPECT_GT(drawn.frequency_hz.size(), 16U);
  Numbers between;
  for (std::size_t i = 1; i < drawn.frequency_hz.size(); ++i)
    between.push_back(std::numbers::pi * (drawn.frequency_hz[i - 1] + drawn.frequency_hz[i]));
  const std::vector<steady::State> states = paths::frequency_response(
      {design.result.model.condensed, {}, optimizer::steady_options(design.scene.solver)}, between);
  const double highest = *std::ranges::max_element(drawn.amplitude_m);
  for (std::size_t i = 0; i < states.size(); ++i)
    EXPECT_NEAR(states[i].amplitudes(0) / highest, (drawn.amplitude_m[i] + drawn.amplitude_m[i + 1]) / 2 / highest,
                0.01)
        << drawn.frequency_hz[i] << " Hz";
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
  ASSERT_EQ(record.notes.size(), 1U);
  EXPECT_NE(record.notes.back().find("infeasible"), std::string::npos);
}

}  // namespace
}  // namespace dovetail::report
