#include "optimizer/evaluator.hpp"

#include <utility>

#include "optimizer/bars/error_bars.hpp"
#include "optimizer/candidate/stopwatch.hpp"
#include "optimizer/mission/mission_bars.hpp"
#include "optimizer/responses/computed.hpp"
#include "optimizer/responses/response_table.hpp"

namespace dovetail::optimizer {

SceneEvaluator::SceneEvaluator(const Scene& reference, std::vector<std::string> named)
    : reference_(reference), named_(std::move(named)), builder_(reference) {}

const OtherMeshes& SceneEvaluator::others() const {
  std::call_once(once_, [this] { others_.emplace(reference_, by_finer_mesh(named_)); });
  return *others_;
}

CandidateResult SceneEvaluator::evaluate(const Scene& scene, const Purpose& purpose) const {
  Stopwatch total;
  Computation how = until(purpose.until, purpose.history);
  CandidateResult result = computed(scene, builder_.build(scene), how);
  if (purpose.bars && result.evaluation.converged()) {
    Stopwatch watch;
    add_error_bars(scene, builder_, purpose.truncation_alone ? nullptr : &others(), how, result);
    result.evaluation.timings_s["error_estimates"] = watch.lap();
  }
  result.evaluation.timings_s["total"] = total.lap();
  return result;
}

Evaluation SceneEvaluator::evaluate_mission(const MissionLoads& loads, const Purpose& purpose) const {
  Stopwatch total;
  Computation how;
  how.history = purpose.history;
  MissionResult result = mission_of(loads, models_of(loads, builder_), how);
  if (purpose.history) confirm_by_history(loads, result);
  if (purpose.bars && result.evaluation.converged()) add_mission_bars(loads, builder_, others(), result);
  result.evaluation.timings_s["total"] = total.lap();
  return result.evaluation;
}

}  // namespace dovetail::optimizer
