#pragma once

#include "studies/report/plots/plot.hpp"
#include "studies/work_precision/growth.hpp"
#include "studies/work_precision/sweep.hpp"

namespace dovetail::work_precision {

/// Seconds against the error of one quantity, log-log: the lines of the sweep with their labels, the part of the error
/// that is the setting's own, the default as a star, failed runs as crosses along the upper edge, how good the
/// reference is, and in the scene the error of its default mesh.
[[nodiscard]] report::Plot error_plot(const Diagram& diagram, const Sweep& sweep, std::size_t quantity);

/// Seconds of a Newton step and its parts over what grows, log-log.
[[nodiscard]] report::Plot growth_plot(const Growth& growth);

}  // namespace dovetail::work_precision
