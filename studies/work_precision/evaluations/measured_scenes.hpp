#pragma once

#include <functional>
#include <string>
#include <vector>

#include "studies/work_precision/evaluations/compute.hpp"

namespace dovetail::work_precision {

/// The section of the study file and two designs from its box that are drawn by a seed; `more` hears of all there
/// is so far.
[[nodiscard]] std::vector<WholeDiagram> measure_section(
    const std::string& study_file, bool quick, const std::function<void(const std::string&)>& progress,
    const std::function<void(const std::vector<WholeDiagram>&)>& more);

/// The sector of the study file.
[[nodiscard]] WholeDiagram measure_sector(const std::string& study_file, bool quick,
                                          const EvaluationListener& listener);

}  // namespace dovetail::work_precision
