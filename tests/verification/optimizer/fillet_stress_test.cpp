#include "optimizer/candidate/fillet_stress.hpp"

#include <gtest/gtest.h>

#include <string>

#include "optimizer/evaluator.hpp"
#include "paths/resonance.hpp"

// The blade's fillet begins where the flank ends. Where that end bears, pressure and stress are singular there and
// grow with every refinement; the fillet's own stress has a limit.

namespace dovetail::optimizer {
namespace {

FilletStress blade_fillet(Scene scene, int flank_elements) {
  scene.mesh.flank_elements = flank_elements;
  scene.solver.harmonics = 1;
  const CandidateModel model = ModelBuilder(scene).build(scene);
  EXPECT_TRUE(model.converged()) << model.status;
  const paths::Resonance unworn = paths::resonance({model.condensed, {}, steady_options(scene.solver)},
                                                   model.reduction.glued_frequencies(scene.loading.mode - 1));
  EXPECT_EQ(unworn.status, Status::converged);
  const fem::SectorMesh& sector = model.mesh.sector;
  return fillet_stress(scene, model, displacement_field(model, unworn.state), sector.blade_fillet_nodes,
                       sector.blade_fillet_share, scene.blade.poisson_ratio);
}

TEST(FilletStress, IsThatOfTheFilletHoweverTheFlankEnds) {
  struct Form {
    double mismatch, crown;
  };
  for (const Form& form : {Form{0, 0}, Form{25e-6, 5.1e-6}, Form{25e-6, -1e-6}, Form{25e-6, -3e-6}}) {
    Scene scene;
    for (geometry::FlankParameters& flank : scene.geometry.flanks) {
      flank.mismatch = form.mismatch;
      flank.crown = form.crown;
    }
    const FilletStress coarse = blade_fillet(scene, 16), fine = blade_fillet(scene, 40);
    const std::string name = "crown_um_" + std::to_string(form.crown * 1e6);
    RecordProperty(name + "_aggregate",
                   std::to_string(coarse.aggregate * 1e-6) + " " + std::to_string(fine.aggregate * 1e-6));
    RecordProperty(name + "_maximum",
                   std::to_string(coarse.maximum * 1e-6) + " " + std::to_string(fine.maximum * 1e-6));
    // Ten elements per radius along the fillet leave some 0.5 %; the loads of the flank's ends are as well known.
    EXPECT_NEAR(coarse.aggregate, fine.aggregate, 0.01 * fine.aggregate) << form.crown;
    EXPECT_NEAR(coarse.maximum, fine.maximum, 0.015 * fine.maximum) << form.crown;
  }
}

}  // namespace
}  // namespace dovetail::optimizer
