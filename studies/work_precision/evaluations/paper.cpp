#include "studies/work_precision/evaluations/paper.hpp"

#include "optimizer/evaluator.hpp"
#include "optimizer/responses/response_table.hpp"
#include "studies/ready_study/processor_time.hpp"
#include "wear/asymptote/drift.hpp"
#include "wear/history/history.hpp"

namespace dovetail::work_precision {
namespace {

constexpr int kHarmonics = 3, kSamples = 128;
constexpr int kStepsBeyond = 5;  // times the steps: those at the end are shorter, as what is left wears slower

/// The worn state and the resonance in it, into the result of an evaluation of the unworn joint.
std::string wear_down(const optimizer::Scene& scene, double increment, int steps, optimizer::CandidateResult& result) {
  steady::Joint joint = optimizer::joint_of(scene, result.model);
  joint.options.budget = {};
  joint.options.slip_return = contact::SlipReturn::first_order;
  wear::HistoryOptions options{.increment = increment, .steps = steps};
  options.finish = false;
  const wear::History history = wear::history(joint, {.omega = result.unworn->omega}, options);
  if (history.end != wear::HistoryEnd::worn_out)
    return optimizer::failed_at(
        "history", history.end == wear::HistoryEnd::failed ? to_string(history.status) : wear::to_string(history.end));
  wear::Asymptote worn;
  worn.verdict = wear::Verdict::asymptote;
  worn.depth = history.final_depth;
  worn.worn_volume = history.final_volume;
  worn.largest_depth = history.final_depth.maxCoeff();
  worn.unworn_rate = history.rate.row(0).transpose();
  worn.rate = history.final_rate;
  result.worn = wear::resonance_drift(joint.worn(worn.depth), *result.unworn, optimizer::resonance_options(scene)).worn;
  result.asymptote = std::move(worn);
  if (result.worn->status != Status::converged) return optimizer::failed_at("worn_resonance", result.worn->status);
  result.stage = optimizer::Stage::worn_resonance;
  return optimizer::status_of(optimizer::Outcome::converged);
}

}  // namespace

WholeSetting paper_setting(const optimizer::Scene& scene) {
  WholeSetting setting = whole_setting(scene);
  setting.harmonics = kHarmonics;
  setting.samples = kSamples;
  setting.solver = steady::Solver::powell;
  return setting;
}

WholeRun paper_history(const MeasuredDesign& design, double depth, int steps) {
  WholeRun run{.setting = paper_setting(design.study().scene), .status = {}, .in_steps = true};
  const optimizer::Scene scene = with_setting(design.study().scene, run.setting);
  const double begin = ready_study::processor_seconds();
  const optimizer::SceneEvaluator evaluator(with_setting(design.reference(), run.setting));
  const double ready = ready_study::processor_seconds();
  optimizer::CandidateResult result =
      evaluator.evaluate(scene, {.bars = false, .history = false, .until = optimizer::Stage::unworn});
  run.status = result.evaluation.status;
  const double before = ready_study::processor_seconds();
  if (run.converged()) run.status = wear_down(scene, depth / steps, kStepsBeyond * steps, result);
  run.timings_s = result.evaluation.timings_s;
  run.timings_s["history"] = ready_study::processor_seconds() - before;
  run.seconds = ready_study::processor_seconds() - ready;
  run.setup_seconds = ready - begin;
  if (!run.converged()) return run;
  for (const optimizer::Response& response : optimizer::responses())
    run.responses[std::string(response.name)] = response.value(scene, result);
  run.dofs = result.evaluation.model["dofs"];
  run.contact_nodes = static_cast<int>(result.model.cells.count());
  return run;
}

}  // namespace dovetail::work_precision
