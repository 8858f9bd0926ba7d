#pragma once

#include <string>
#include <vector>

#include "studies/report/record/run_record.hpp"

namespace dovetail::report {

/// What became better and what worse, of every objective and every limit, with bars and a verdict; empty where nothing
/// was computed.
[[nodiscard]] std::string outcome_table(const RunRecord& record);

// Sentences, plain text.

/// How well the numbers of the best design are known: bars, verification, finer meshes.
[[nodiscard]] std::vector<std::string> how_sure(const RunRecord& record);
/// Where something is other than the study says.
[[nodiscard]] std::vector<std::string> how_far(const RunRecord& record);
/// What to do next.
[[nodiscard]] std::vector<std::string> what_next(const RunRecord& record);

}  // namespace dovetail::report
