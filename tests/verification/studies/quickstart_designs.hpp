/// Designs around the quickstart's for tests.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "optimizer/evaluator.hpp"
#include "studies/program/engine/engine.hpp"
#include "studies/program/study_file/study.hpp"

namespace dovetail::studies {

/// Keys and the values they have instead of the quickstart's.
using Changes = std::vector<std::pair<std::string, double>>;

inline optimizer::Scene changed(optimizer::Scene scene, const Changes& changes) {
  for (const auto& [key, value] : changes) optimizer::set_parameter(scene, key, value);
  return scene;
}

inline optimizer::CandidateResult evaluated(const Changes& changes, const optimizer::Purpose& purpose,
                                            const std::vector<std::string>& named = {}) {
  const optimizer::Scene scene = changed(load_study(QUICKSTART, {}).scene, changes);
  return optimizer::SceneEvaluator(scene, named).evaluate(scene, purpose);
}

inline optimizer::CandidateResult evaluated(const Changes& changes, bool bars) {
  return evaluated(changes, {.bars = bars});
}

/// On the mesh that `evaluate` takes for every design of the study.
inline optimizer::CandidateResult evaluated_in_study(const Changes& changes, bool bars = false) {
  const Study study = load_study(QUICKSTART, {});
  return scene_evaluator(study)->evaluate(changed(study.scene, changes), {.bars = bars});
}

}  // namespace dovetail::studies
