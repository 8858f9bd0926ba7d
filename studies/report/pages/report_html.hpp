#pragma once

#include <filesystem>
#include <string>

#include "studies/report/record/run_record.hpp"

namespace dovetail::report {

/// The report as one self-contained page: no scripts, no other files, light and dark. Made from the record alone.
/// What is missing in the record (no feasible design, interrupted, no history) is said in a sentence.
[[nodiscard]] std::string report_html(const RunRecord& record);

/// Writes it beside `file` and renames. Throws InputError when it cannot be written.
void write_report(const std::filesystem::path& file, const RunRecord& record);

}  // namespace dovetail::report
