#pragma once

#include "studies/report/plots/plot.hpp"
#include "studies/work_precision/evaluations/points.hpp"

namespace dovetail::work_precision {

/// Seconds of an evaluation against the error of one response, or of the worst one that counts, log-log: a line for
/// each knob, dots for combinations, the front as steps, the paper's settings, the program's choices, failed
/// evaluations as crosses along the upper edge, shaded what the references do not resolve.
[[nodiscard]] report::Plot response_plot(const WholeDiagram& diagram, const std::string& response);

/// Some error is above rounding.
[[nodiscard]] bool errs(const WholeDiagram& diagram, const std::string& response);

}  // namespace dovetail::work_precision
