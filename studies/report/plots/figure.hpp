#pragma once

#include <string>
#include <variant>
#include <vector>

#include "studies/report/plots/flank_map.hpp"
#include "studies/report/plots/plot.hpp"

namespace dovetail::report {

/// What a page shows with a title, a sentence and its numbers.
using Figure = std::variant<Plot, FlankMap>;

/// <figure>: title, legend, drawing, description, and the numbers as a table under <details>. An empty figure becomes a
/// sentence.
[[nodiscard]] std::string figure_html(const Figure& figure);

/// Figures side by side.
[[nodiscard]] std::string figures_html(const std::vector<Figure>& figures);

/// One row per point: name of the series, x, y; of a map: flank, place along the slot and from the neck side, value.
[[nodiscard]] std::string figure_csv(const Figure& figure);

}  // namespace dovetail::report
