#pragma once

#include <string>

#include "studies/report/record/run_record.hpp"

namespace dovetail::report {

/// What was optimised, from what to what, and whether that is beyond the error bars. Plain text sentences; says so when
/// no feasible design was found.
[[nodiscard]] std::string headline(const RunRecord& record);

}  // namespace dovetail::report
