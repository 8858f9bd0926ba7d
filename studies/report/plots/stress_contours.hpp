#pragma once

#include <string>

#include "studies/report/plots/report_plots.hpp"

namespace dovetail::report {

/// Von Mises stress of the spin-up around the joint, start and best design with one scale of colours, the largest one
/// marked; in space a cut through it. Empty where no stress was computed.
[[nodiscard]] std::string stress_figures(const Comparison& designs);

}  // namespace dovetail::report
