#pragma once

#include <functional>

#include "optimizer/problem/evaluation.hpp"
#include "optimizer/scene/scene.hpp"
#include "optimizer/verification.hpp"
#include "studies/program/study_file/study.hpp"
#include "studies/report/record/run_record.hpp"
#include "wear/watcher.hpp"

namespace dovetail::studies {

/// A design looked at more closely than a search does.
struct DescribedDesign {
  optimizer::Evaluation evaluation;
  report::DesignRecord record;
};

/// What a run computes with.
struct RunEngine {
  optimizer::Evaluator evaluate;  ///< design variables in, evaluation out
  /// The study's own design with bars, as far as a candidate is computed; empty: there are none.
  std::function<optimizer::Evaluation()> start = {};
  /// The same on finer meshes; empty: limits are kept on one mesh.
  optimizer::FinerEvaluator finer = {};
  /// The design with bars and what the wear history decides, as far as the study's responses need, and with the curves
  /// and fields that results and report show; empty: they show none.
  std::function<DescribedDesign(const optimizer::Scene&)> describe;
  /// The design's wear by the full history, at settings that are handed over or, without them, at finer ones; empty:
  /// designs are not verified.
  std::function<report::VerificationRecord(const optimizer::Scene&, const optimizer::FinerDesign*,
                                           const wear::Watcher&)>
      verify = {};
};

/// Makes the engine of a study.
using RunEngineFactory = std::function<RunEngine(const Study&)>;

/// The physics.
[[nodiscard]] RunEngine study_engine(const Study& study);

}  // namespace dovetail::studies
