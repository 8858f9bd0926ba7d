// Under a wear law that lets nodes rest in slip, contact cells end where the history says that worn zones end.
#include <gtest/gtest.h>

#include "optimizer/candidate/candidate_result.hpp"

namespace dovetail::optimizer {
namespace {

double worn_volume(double threshold, int flank_elements) {
  Scene scene;
  scene.contact.wear_law = "energy";
  scene.contact.wear.at("energy").threshold = threshold;
  scene.mesh.flank_elements = flank_elements;
  const CandidateResult candidate = through_stages(scene, ModelBuilder(scene).build(scene), {});
  EXPECT_TRUE(candidate.evaluation.converged());
  EXPECT_LT(candidate.evaluation.model.at("contact_edges_moved"), 0.02);
  return candidate.asymptote->worn_volume;
}

// Cells laid for the zones that release finds, which are wider, made these volumes differ by up to 37 per cent, and
// their edges did not settle.
TEST(ThresholdZones, GiveOneVolumeOnCoarseAndFineMeshes) {
  for (const double threshold : {20.0, 40.0}) {
    const double coarse = worn_volume(threshold, 16), fine = worn_volume(threshold, 26);
    RecordProperty("change_" + std::to_string(threshold), std::to_string(fine / coarse - 1));
    EXPECT_GT(fine, 0);
    EXPECT_NEAR(fine / coarse, 1, 0.08);
  }
}

}  // namespace
}  // namespace dovetail::optimizer
