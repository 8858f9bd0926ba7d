#include "optimizer/evaluator.hpp"

#include "optimizer/bars/error_bars.hpp"
#include "optimizer/candidate/stopwatch.hpp"
#include "optimizer/responses/computed.hpp"

namespace dovetail::optimizer {

SceneEvaluator::SceneEvaluator(const Scene& reference) : reference_(reference), builder_(reference) {}

const OtherMeshes& SceneEvaluator::others() const {
  std::call_once(once_, [this] { others_.emplace(reference_); });
  return *others_;
}

CandidateResult SceneEvaluator::evaluate(const Scene& scene, const Purpose& purpose) const {
  Stopwatch total;
  Computation how = until(purpose.until, purpose.history);
  CandidateResult result = computed(scene, builder_.build(scene), how);
  if (purpose.bars && result.evaluation.converged()) {
    Stopwatch watch;
    add_error_bars(scene, builder_, others(), how, result);
    result.evaluation.timings_s["error_estimates"] = watch.lap();
  }
  result.evaluation.timings_s["total"] = total.lap();
  return result;
}

}  // namespace dovetail::optimizer
