#pragma once

#include <functional>
#include <string>

#include "studies/work_precision/evaluations/plan.hpp"
#include "studies/work_precision/evaluations/points.hpp"

namespace dovetail::work_precision {

/// Who hears of the progress.
struct EvaluationListener {
  std::function<void(const std::string&)> progress = {};  ///< a line for people
  std::function<void(const WholeDiagram&)> more = {};     ///< the diagram with all there is so far
};

/// One design, measured by a plan. A design of the box that is not the file's is given by its variables.
[[nodiscard]] WholeDiagram measure_design(const std::string& study_file, const EvaluationPlan& plan, WholeDiagram named,
                                          const EvaluationListener& listener);

}  // namespace dovetail::work_precision
