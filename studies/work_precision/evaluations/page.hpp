#pragma once

#include <string>
#include <vector>

#include "studies/work_precision/evaluations/points.hpp"

namespace dovetail::work_precision {

/// A section of the page for each design: how long for which accuracy, verdicts, a drawing per response, the numbers.
[[nodiscard]] std::string evaluations_html(const std::vector<WholeDiagram>& diagrams);

}  // namespace dovetail::work_precision
