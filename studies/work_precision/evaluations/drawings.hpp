#pragma once

#include <string>
#include <vector>

#include "studies/report/plots/plot.hpp"
#include "studies/report/words/table.hpp"

namespace dovetail::work_precision {

/// A number by its format, a dash where there is none.
[[nodiscard]] std::string cell(double value, const char* format);

/// Without rows yet.
[[nodiscard]] report::Table table_of(const std::vector<const char*>& headings);

/// <figure> of one plot.
[[nodiscard]] std::string drawing(const report::Plot& plot);

/// Drawings side by side over their numbers.
[[nodiscard]] std::string side_by_side(const std::string& drawings, const report::Table& table);

}  // namespace dovetail::work_precision
