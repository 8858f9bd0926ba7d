// Compares two designs of a study:  compare_designs STUDY.toml
#include <array>
#include <cstdio>
#include <memory>

#include "numerics/process.hpp"
#include "studies/program/engine/engine.hpp"
#include "studies/program/study_file/study.hpp"

int main(int argc, char** argv) try {
  using namespace dovetail;
  if (argc != 2) {
    std::fprintf(stderr, "usage: compare_designs STUDY.toml\n");
    return 2;
  }
  numerics::prepare_process(argv);
  for (const char* mismatch : {"0", "5"}) {
    const std::array set{studies::Override{"geometry.flank_mismatch_um", mismatch, "compare_designs"}};
    const studies::Study study = studies::load_study(argv[1], set);
    const std::shared_ptr<const optimizer::SceneEvaluator> evaluator = studies::scene_evaluator(study);
    // As a search does it: without error bars and wear histories, about a second.
    const optimizer::CandidateResult result = evaluator->evaluate(study.scene, optimizer::kSearch);
    if (!result.evaluation.converged()) {
      std::fprintf(stderr, "%s\n", result.evaluation.status.c_str());
      return 3;
    }
    std::printf("mismatch %s um: resonance %.2f Hz, worn off %.4f mm^3\n", mismatch,
                result.evaluation.responses.at("resonance_hz"),
                1e9 * result.evaluation.responses.at("asymptotic_wear_volume_m3"));
  }
} catch (const dovetail::InputError& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
