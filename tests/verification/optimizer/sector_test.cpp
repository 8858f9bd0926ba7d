// The same joint as a plane section and as a sector in space with a straight slot and uniform load: what agrees, how
// well, and why not better. The plane meshes are the same, so differences are those of finite length, not of meshes.
// The section is in plane strain; the sector's end faces, and those of its slender aerofoil, are free.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "fem/diameter_frequencies.hpp"
#include "fem/flank_trace.hpp"
#include "geometry/solid/solid_family.hpp"
#include "optimizer/bars/other_meshes.hpp"
#include "optimizer/bars/params.hpp"
#include "optimizer/candidate/matrices.hpp"
#include "optimizer/evaluator.hpp"
#include "optimizer/responses/computed.hpp"
#include "tests/verification/optimizer/sector_joint.hpp"

namespace dovetail::optimizer {
namespace {

using testing::flank_loads;
using testing::FlankLoad;
using testing::joint;
using testing::longer;

/// With few modes: what is static does not depend on them, and the first frequency hardly.
CandidateModel static_model_of(Scene scene) {
  scene.solver.modes = 8;
  return ModelBuilder(scene).build(scene);
}

double difference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return (a - b).cwiseAbs().maxCoeff();
}

double standing_frequency(const fem::SectorMesh& sector, const std::vector<fem::Material>& materials) {
  const fem::FullMatrices full = fem::Assembler(sector.mesh).stiffness_and_mass(sector.mesh, materials);
  const std::vector<int> diameters{0};
  return fem::nodal_diameter_frequencies(sector, full.stiffness, full.mass, fem::BoreSupport::tangential,
                                         {.modes = {.count = 1}}, diameters)
      .frequency(0, 0);
}

// What designs would share of a sector with fine flanks is too large to be kept.
TEST(Sector, SharesMatricesWhereWhatIsKeptOfThemFits) {
  Scene scene = joint(kSector);
  const auto prestress = [&scene] {
    return prestress_of(
        scene, fem::with_trace(geometry::mesh_solid(scene.geometry, scene.solid, scene.mesh, scene.solid_mesh).sector));
  };
  EXPECT_EQ(prestress(), Prestress::own);
  scene.solver.prestress = Prestress::shared;
  EXPECT_EQ(prestress(), Prestress::shared);
  scene.mesh.flank_elements = 20;
  scene.solid_mesh.contact_slot_elements = 14;
  scene.solid_mesh.slot_elements = 14;
  EXPECT_EQ(prestress(), Prestress::own);
  // What the cases of one design share is kept anyway.
  scene.solver.prestress = Prestress::cases;
  EXPECT_EQ(prestress(), Prestress::cases);
}

TEST(SectorAgainstSection, FrequencyAtRestLiesBetweenPlaneStressAndPlaneStrain) {
  // Plane strain holds the solid (u_z = 0), so its frequency is above. Plane stress is the least strain energy that
  // displacements in the plane can have, so its frequency is below but for the little inertia of u_z.
  const Scene scene = joint(kSector);
  const std::vector<fem::Material> bodies = materials(scene);
  fem::SectorMesh plane = geometry::mesh_sector(scene.geometry, scene.mesh).sector;
  const double section = standing_frequency(plane, bodies);
  const auto with = [&](bool plane_stress) {
    for (fem::Region& region : plane.mesh.regions) region.plane_stress = plane_stress;
    return standing_frequency(plane, bodies);
  };
  const double stress = with(true), strain = with(false);
  const double space = standing_frequency(
      geometry::mesh_solid(scene.geometry, scene.solid, scene.mesh, scene.solid_mesh).sector, bodies);
  EXPECT_LT(stress, space);
  EXPECT_LT(space, strain);
  // The bounds are 1 / sqrt(1 - nu^2) = 1.06 apart.
  EXPECT_NEAR(strain / stress, 1 / std::sqrt(1 - std::pow(scene.blade.poisson_ratio, 2)), 0.01);
  EXPECT_NEAR(space, section, 0.04 * section);
}

TEST(SectorAgainstSection, PreloadAgreesAndMoreSoInALongerSlot) {
  const CandidateModel section = static_model_of(joint(kSection));
  ASSERT_TRUE(section.converged()) << section.status;
  const std::vector<FlankLoad> flat = flank_loads(section);
  // Differences over the mean pressure, of the profile in the middle of the slot, and of the glued frequencies.
  std::vector<double> middle, frequency;
  for (const int factor : {1, 2}) {
    const CandidateModel sector = static_model_of(longer(joint(kSector), factor));
    ASSERT_TRUE(sector.converged()) << sector.status;
    const std::vector<FlankLoad> deep = flank_loads(sector);
    ASSERT_EQ(deep.size(), 2U);
    for (std::size_t f = 0; f < 2; ++f) {
      // The blade's pull fixes the resultants but for friction, which slides towards the neck alike (measured 0.07 to
      // 0.15 % and 0.07 to 0.25 %). Twice the length, twice the force.
      EXPECT_NEAR(deep[f].normal, factor * flat[f].normal, 0.003 * factor * flat[f].normal);
      EXPECT_NEAR(deep[f].tangential, factor * flat[f].tangential, -0.005 * factor * flat[f].tangential);
      EXPECT_NEAR(deep[f].axial, 0, 1e-8 * flat[f].normal);
      EXPECT_NEAR(deep[f].mean(), flat[f].mean(), 0.003 * flat[f].mean());
      // Near its free ends the slot carries more (22 %, over 10 mm), in the middle less. Averaged along it the profile
      // is the section's but for its own ends (7 % of the mean; 3 % elsewhere), where the pressure is singular.
      EXPECT_LT(difference(deep[f].profile(), flat[f].profile()), 0.1 * flat[f].mean());
      const Eigen::Index last = deep[f].pressure.cols() - 1;
      EXPECT_GT(deep[f].pressure.col(0).mean(), 1.1 * deep[f].middle().mean());
      EXPECT_NEAR(deep[f].pressure.col(0).mean(), deep[f].pressure.col(last).mean(), 1e-6 * flat[f].mean());
    }
    // But for the cells at the ends, where the pressure is singular.
    const Eigen::Index inner = deep[0].pressure.rows() - 2;
    middle.push_back(difference(deep[0].middle().segment(1, inner), flat[0].middle().segment(1, inner)) /
                     flat[0].mean());
    frequency.push_back(std::abs(sector.reduction.glued_frequencies(0) / section.reduction.glued_frequencies(0) - 1));
  }
  // What the ends take does not grow with the slot, so the middle lacks half as much in one twice as long (measured
  // 0.15 and 0.07, next to the neck; 0.04 elsewhere). The aerofoil, as wide as the slot is long, comes
  // nearer to the section's plane strain (0.017 and 0.012), but stays far from it while its chord is not many times its
  // span.
  EXPECT_LT(middle[0], 0.17);
  EXPECT_LT(middle[1], 0.65 * middle[0]);
  EXPECT_LT(frequency[0], 0.025);
  EXPECT_LT(frequency[1], 0.85 * frequency[0]);
}

CandidateResult vibration(const Scene& scene) {
  return computed(scene, ModelBuilder(scene).build(scene));
}

TEST(SectorAgainstSection, ResonanceAndAsymptoticWearAgree) {
  const CandidateResult flat = vibration(joint(kSection)), deep = vibration(joint(kSector));
  ASSERT_TRUE(flat.evaluation.converged()) << flat.evaluation.status;
  ASSERT_TRUE(deep.evaluation.converged()) << deep.evaluation.status;
  // The frequencies differ as the glued ones do.
  EXPECT_NEAR(deep.unworn->omega, flat.unworn->omega, 0.025 * flat.unworn->omega);
  // At resonance the amplitude is F / (2 zeta omega^2 m) less what friction takes: 1.7 % in frequency are 3.4 % in it
  // (measured 2.5 %).
  EXPECT_NEAR(deep.unworn->amplitude, flat.unworn->amplitude, 0.06 * flat.unworn->amplitude);
  // Slip is where the pressure is least, at the neck side, and there the middle of the slot has 15 % less of it: zones
  // of slip are wider by as much (measured 17 %).
  const double energy = flat.unworn->state.friction_energy;
  EXPECT_NEAR(deep.unworn->state.friction_energy, energy, 0.3 * energy);
  // At its ends the slot carries more and slips less, in the middle the other way round: there the wear is deeper than
  // the section's (25 %) and at the ends less deep (43 %), and the volumes agree (2.3 %).
  EXPECT_NEAR(deep.asymptote->worn_volume, flat.asymptote->worn_volume, 0.07 * flat.asymptote->worn_volume);
  const auto deepest = [&](int strip) {
    double depth = 0;
    for (int i = 0; i < deep.model.cells.count(); ++i)
      if (deep.model.cells.strip(i) == strip) depth = std::max(depth, deep.asymptote->depth(i));
    return depth;
  };
  EXPECT_LT(deepest(0), flat.asymptote->largest_depth);
  EXPECT_GT(deepest(1), flat.asymptote->largest_depth);
  EXPECT_NEAR(deepest(1), deepest(2), 1e-6 * deepest(1));
  EXPECT_NEAR((deepest(0) + deepest(1)) / 2, flat.asymptote->largest_depth, 0.2 * flat.asymptote->largest_depth);
}

// In space none is finer, whatever a study is about.
TEST(OtherMeshes, AreFinerInThePlaneAlone) {
  Scene space = joint(kSector), plane = joint(kSection);
  space.mesh.flank_elements = 4;
  space.solid_mesh.slot_elements = 2;
  const auto sizes = [](const Scene& scene, bool finer) {
    const OtherMeshes others(scene, finer);
    return std::pair{others.meshes()[0].ratio, others.meshes()[1].ratio};
  };
  for (const bool finer : {false, true}) EXPECT_EQ(sizes(space, finer), std::pair(1.5, 2.0));
  // But where none is coarser.
  space.mesh.flank_elements = 2;
  EXPECT_EQ(sizes(space, false), std::pair(1 / 1.5, 1.5));
  plane.mesh.flank_elements = kSection.finer_below - 1;
  EXPECT_EQ(sizes(plane, false), std::pair(1 / 1.5, 1.5));
  plane.mesh.flank_elements = kSection.finer_below;
  EXPECT_EQ(sizes(plane, false), std::pair(1.5, 2.0));
  EXPECT_EQ(sizes(plane, true), std::pair(1 / 1.5, 1.5));
}

TEST(OtherMeshes, ShowAFinerSectionOnFewLayers) {
  Scene space = joint(kSector);
  space.mesh.flank_elements = 4;
  space.solid_mesh.slot_elements = 8;
  const Scene few = with_few_layers(space);
  EXPECT_LT(few.solid_mesh.slot_elements, 8);
  EXPECT_EQ(few.solid_mesh.contact_slot_elements, 0) << "as many as layers";
  EXPECT_EQ(few.mesh.flank_elements, 4);
  ASSERT_NE(OtherMeshes(space).sections(), nullptr);
  EXPECT_TRUE(OtherMeshes(space).sections()->own);
  EXPECT_FALSE(OtherMeshes(few).sections()->own) << "the design itself has no more";
  EXPECT_EQ(OtherMeshes(joint(kSection)).sections(), nullptr);
}

// Frequencies hardly depend on the layers, by which a coarse section makes the neck too stiff.
TEST(OtherMeshes, AFinerSectionSaysOnFewLayersWhatItSaysOnAll) {
  Scene all = joint(kSector);
  all.mesh.flank_elements = 4;
  all.mesh.bulk_size = 8e-3;
  all.solid_mesh.slot_elements = 6;
  all.solid.skew_angle = 0.2;
  const auto change = [](const Scene& own) {
    const Scene finer = resized_section(own, CompanionParams{}.section_ratio);
    const auto frequency = [](const Scene& scene) {
      const Evaluation of = SceneEvaluator(scene).evaluate(scene, {.bars = false, .until = Stage::unworn}).evaluation;
      return of.responses.at("glued_frequency_hz");
    };
    return frequency(finer) / frequency(own) - 1;
  };
  const double whole = change(all), few = change(with_few_layers(all));
  EXPECT_LT(whole, 0);
  EXPECT_NEAR(few, whole, 0.2 * std::abs(whole));
}

TEST(SectorEvaluation, ConvergesWithEveryResponseAndItsErrorBar) {
  Scene scene = joint(kSector);
  scene.mesh.flank_elements = 4;
  scene.solid_mesh.slot_elements = 2;
  scene.solid.skew_angle = 0.1;
  const Evaluation evaluation = SceneEvaluator(scene).evaluate(scene).evaluation;
  ASSERT_TRUE(evaluation.converged()) << evaluation.status;
  for (const auto& [name, value] : evaluation.responses) EXPECT_TRUE(std::isfinite(value)) << name;
  EXPECT_GE(evaluation.responses.size(), 17U);
  for (const auto& [name, bar] : evaluation.error_estimates) EXPECT_TRUE(std::isfinite(bar) && bar >= 0) << name;
  // Worn zones of whole nodes end somewhere before the next: on this grid the volume is not known to 10 %.
  const double volume = evaluation.responses.at("asymptotic_wear_volume_m3");
  const double bar = evaluation.error_estimates.at("asymptotic_wear_volume_m3");
  EXPECT_GT(bar, 0.1 * volume);
  EXPECT_LT(bar, volume);
  // The coarser meshes of the bars have the same fillets and blends.
  Scene finer = scene;
  finer.mesh.fillet_fraction = 0.25;
  finer.mesh.blend_fraction = 0.3;
  finer.mesh.bulk_size = 5e-3;
  const Evaluation section =
      SceneEvaluator(finer).evaluate(finer, {.bars = false, .history = false, .until = Stage::unworn}).evaluation;
  ASSERT_TRUE(section.converged()) << section.status;
  for (const char* name :
       {"contact_pressure_mean_pa", "neck_tension_pa", "blade_fillet_stress_pa", "disk_fillet_stress_pa"})
    EXPECT_NEAR(evaluation.responses.at(name), section.responses.at(name), evaluation.error_estimates.at(name)) << name;
}

TEST(SectorSymmetry, MirroredSlotsHaveMirroredPressures) {
  // The plane mesh is symmetric, so these hold to rounding and the tolerance of the preload.
  std::vector<std::vector<FlankLoad>> loads;
  std::vector<double> frequency;
  for (const double skew : {0.0, 20.0, -20.0}) {
    Scene scene = joint(kSector);
    scene.mesh.flank_elements = 4;
    scene.solid.skew_angle = skew * std::numbers::pi / 180;
    const CandidateModel model = static_model_of(scene);
    ASSERT_TRUE(model.converged()) << model.status;
    loads.push_back(flank_loads(model));
    frequency.push_back(model.reduction.glued_frequencies(0));
  }
  const double tolerance = 1e-6 * loads[0][0].mean();
  // A straight slot: left and right, front and back are alike.
  EXPECT_LT(difference(loads[0][0].pressure, loads[0][1].pressure), tolerance);
  EXPECT_LT(difference(loads[0][0].pressure, loads[0][0].pressure.rowwise().reverse()), tolerance);
  // A skewed one: half a turn about the radial direction brings left to right, front to back.
  EXPECT_LT(difference(loads[1][0].pressure, loads[1][1].pressure.rowwise().reverse()), tolerance);
  EXPECT_GT(difference(loads[1][0].pressure, loads[1][1].pressure), 0.1 * loads[1][0].mean());
  // The mirror image in the plane x = 0 swaps the flanks and the sign of the skew.
  EXPECT_LT(difference(loads[1][0].pressure, loads[2][1].pressure), tolerance);
  EXPECT_LT(difference(loads[1][1].pressure, loads[2][0].pressure), tolerance);
  EXPECT_NEAR(frequency[1], frequency[2], 1e-8 * frequency[1]);
}
}  // namespace
}  // namespace dovetail::optimizer
