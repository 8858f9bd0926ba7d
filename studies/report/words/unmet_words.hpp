#pragma once

#include <string>
#include <vector>

#include "studies/report/record/run_record.hpp"

namespace dovetail::report {

/// Where nothing could be computed how most candidates ended: "asymptote: no_asymptote in 6 of 6"; else nothing.
[[nodiscard]] std::string why_none(const RunRecord& record);

/// The limits and rules that no candidate keeps, each with how near the nearest one comes.
[[nodiscard]] std::vector<std::string> never_kept(const RunRecord& record);

}  // namespace dovetail::report
