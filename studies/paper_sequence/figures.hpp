#pragma once

#include <string>
#include <utility>
#include <vector>

#include "studies/paper_sequence/results.hpp"
#include "studies/report/plots/figure.hpp"

namespace dovetail::paper_sequence {

/// A plot, or in space a map over the flanks.
using report::Figure;

/// All figures in the reference's order, each with its name: that of the file of its numbers, and of its place on the
/// page.
[[nodiscard]] std::vector<std::pair<std::string, Figure>> figures(const Results& results);

}  // namespace dovetail::paper_sequence
