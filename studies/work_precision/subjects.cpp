#include "studies/work_precision/subjects.hpp"

#include <cmath>
#include <map>
#include <memory>
#include <utility>

#include "optimizer/candidate/candidate_model.hpp"
#include "studies/program/study_file/study.hpp"
#include "studies/ready_study/processor_time.hpp"

namespace dovetail::work_precision {
namespace {

using ready_study::processor_seconds;

constexpr double kTolerance = 1e-10;  // of the residual: far below every error looked at

struct BuiltScene {
  optimizer::CandidateModel model;
  double seconds = 0;
};

optimizer::Scene with_mesh(optimizer::Scene scene, const Setting& setting) {
  const double ratio = static_cast<double>(scene.mesh.flank_elements) / setting.flank_elements;
  scene.mesh.flank_elements = setting.flank_elements;
  scene.mesh.fillet_fraction *= ratio;
  scene.mesh.bulk_size *= ratio;
  scene.mesh.aerofoil_elements = static_cast<int>(std::lround(scene.mesh.aerofoil_elements / ratio));
  scene.solver.modes = setting.modes;
  return scene;
}

}  // namespace

Subject patch_subject(const PatchOptions& options, double seconds) {
  const auto model = std::make_shared<const dynamics::CondensedModel>(contact_patch(options));
  return [model, seconds](const Setting& setting) {
    return timed_resonance(model, model->glued_frequencies()(0), setting, kTolerance, seconds);
  };
}

Subject scene_subject(const std::string& study_file, double seconds) {
  const optimizer::Scene scene = studies::load_study(study_file).scene;
  const auto kept = std::make_shared<std::map<std::pair<int, int>, BuiltScene>>();
  return [scene, kept, seconds](const Setting& setting) {
    const std::pair<int, int> key{setting.flank_elements, setting.modes};
    if (!kept->contains(key)) {
      const optimizer::Scene meshed = with_mesh(scene, setting);
      const double before = processor_seconds();
      BuiltScene built{.model = optimizer::ModelBuilder(meshed).build(meshed)};
      built.seconds = processor_seconds() - before;
      kept->emplace(key, std::move(built));
    }
    const BuiltScene& built = kept->at(key);
    Run run;
    run.setting = setting;
    if (built.model.converged()) {
      const double glued = built.model.glued_frequencies(scene.loading.mode - 1);
      run = timed_resonance(built.model.condensed, glued, setting, kTolerance, seconds);
    } else {
      run.status = built.model.status;
    }
    run.model_seconds = built.seconds;
    return run;
  };
}

}  // namespace dovetail::work_precision
