#pragma once

#include <string>

#include "studies/report/record/run_record.hpp"

namespace dovetail::studies {

/// All candidates of a run as comma-separated values, a line each: number (from 1), phase, status, feasible, objective,
/// violation, seconds, the variables in the file's units, every response that any has, its error bar where any has one,
/// and the limits, kept when <= 0. Unknown values are empty.
[[nodiscard]] std::string candidate_table(const report::RunRecord& record);

/// A text of such a table, in quotes where a reader would split it.
[[nodiscard]] std::string csv_cell(const std::string& text);

/// A number of such a table: the shortest text that reads back to the same double; empty unless it is finite.
[[nodiscard]] std::string table_number(double value);

}  // namespace dovetail::studies
