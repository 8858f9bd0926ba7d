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

/// The section of the study file and two designs from its box that are drawn by a seed; `finished` gets each as it
/// grows.
[[nodiscard]] std::vector<WholeDiagram> measure_section(
    const std::string& study_file, bool quick, const std::function<void(const std::string&)>& progress,
    const std::function<void(const std::vector<WholeDiagram>&)>& more);

/// The sector of the study file.
[[nodiscard]] WholeDiagram measure_sector(const std::string& study_file, bool quick,
                                          const EvaluationListener& listener);

}  // namespace dovetail::work_precision
