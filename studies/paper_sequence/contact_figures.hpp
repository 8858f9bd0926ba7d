#pragma once

#include "studies/paper_sequence/results.hpp"
#include "studies/report/plots/figure.hpp"

namespace dovetail::paper_sequence {

// Quantities of the contact nodes: along the flanks in the plane, over them in space.

[[nodiscard]] report::Figure pressure_figure(const Results& results);
[[nodiscard]] report::Figure first_rate_figure(const Results& results);
[[nodiscard]] report::Figure profile_figure(const Results& results);

}  // namespace dovetail::paper_sequence
