#include "studies/work_precision/evaluations/design.hpp"

#include <utility>

#include "optimizer/bars/other_meshes.hpp"
#include "optimizer/evaluator.hpp"
#include "optimizer/responses/response_table.hpp"
#include "optimizer/search/space_filling.hpp"
#include "studies/program/engine/engine.hpp"
#include "studies/ready_study/processor_time.hpp"

namespace dovetail::work_precision {
namespace {

using ready_study::processor_seconds;

constexpr std::size_t kDrawn = 16;  // designs from which the first are taken

/// On a topology of its own: matrices of an earlier evaluation would make it look cheaper than a new design is.
WholeRun evaluated(const optimizer::Scene& reference, const optimizer::Scene& scene, const WholeSetting& setting) {
  WholeRun run{.setting = setting, .status = {}};
  const double begin = processor_seconds();
  double ready = begin;
  const optimizer::Evaluation evaluation = optimizer::evaluated_or_refused([&] {
    const optimizer::SceneEvaluator evaluator(with_setting(reference, setting));
    ready = processor_seconds();
    return evaluator.evaluate(with_setting(scene, setting), optimizer::kSearch).evaluation;
  });
  run.seconds = processor_seconds() - ready;
  run.setup_seconds = ready - begin;
  run.status = evaluation.status;
  run.timings_s = evaluation.timings_s;
  run.responses = evaluation.responses;
  const auto size = [&](const char* name) {
    const auto found = evaluation.model.find(name);
    return found == evaluation.model.end() ? 0.0 : found->second;
  };
  run.dofs = size("dofs");
  run.contact_nodes = static_cast<int>(size("contact_nodes"));
  return run;
}

}  // namespace

MeasuredDesign::MeasuredDesign(studies::Study study, const std::map<std::string, double>& variables)
    : study_(std::move(study)), reference_(studies::reference_scene(study_)) {
  for (const auto& [key, value] : variables) optimizer::set_parameter(study_.scene, key, value);
}

const WholeRun& MeasuredDesign::operator()(const WholeSetting& setting) {
  if (const auto found = kept_.find(setting); found != kept_.end()) return found->second.run;
  WholeRun run = evaluated(reference_, study_.scene, setting);
  std::vector<double> seconds{run.seconds};
  return kept_.emplace(setting, Kept{.run = std::move(run), .seconds = std::move(seconds)}).first->second.run;
}

void MeasuredDesign::repeat(const WholeSetting& setting) {
  const auto found = kept_.find(setting);
  if (found == kept_.end()) return;
  Kept& kept = found->second;
  kept.seconds.push_back(evaluated(reference_, study_.scene, setting).seconds);
  kept.run.seconds = ready_study::median(kept.seconds);
  kept.run.repetitions = static_cast<int>(kept.seconds.size());
}

studies::Study load_coarser(const std::string& file, double coarser) {
  studies::Study study = studies::load_study(file);
  if (coarser != 1) study.scene = optimizer::resized(std::move(study.scene), coarser);
  return study;
}

std::vector<std::map<std::string, double>> random_designs(const studies::Study& study, int count, int seed) {
  const optimizer::DesignSpace& space = study.problem.space;
  std::vector<std::map<std::string, double>> designs;
  if (space.size() == 0) return designs;
  const WholeSetting setting = whole_setting(study.scene);
  for (const std::vector<double>& unit :
       optimizer::latin_hypercube(kDrawn, space.size(), static_cast<std::uint64_t>(seed))) {
    if (static_cast<int>(designs.size()) == count) break;
    std::map<std::string, double> design = space.settings(space.from_unit(unit));
    const WholeRun run = MeasuredDesign(study, design)(setting);
    if (run.converged() && run.responses.at(std::string(optimizer::kWornVolume.name)) > 0)
      designs.push_back(std::move(design));
  }
  return designs;
}

}  // namespace dovetail::work_precision
