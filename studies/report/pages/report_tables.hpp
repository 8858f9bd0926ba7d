#pragma once

#include <string>

#include "studies/report/record/run_record.hpp"

namespace dovetail::report {

// Pieces of the page as HTML; every text of the record is escaped.

/// Responses of the start and the best design (or of the only one there is) with error bars and change. A sentence when
/// neither was computed.
[[nodiscard]] std::string key_figures(const RunRecord& record);

/// The responses that objective and limits name, case by case; empty without cases.
[[nodiscard]] std::string case_table(const RunRecord& record);
/// What the cases are; empty without.
[[nodiscard]] std::string case_list(const RunRecord& record);

/// Points of a front: those with bars, all of them collapsed; empty without a front.
[[nodiscard]] std::string front_table(const RunRecord& record);

/// Design variables with bounds, start, best and whether at a bound.
[[nodiscard]] std::string variable_table(const RunRecord& record);

/// What each variable does to objectives and limited responses; a sentence where too few candidates tell.
[[nodiscard]] std::string influence_table(const RunRecord& record);

/// What was minimised and under which limits.
[[nodiscard]] std::string problem_list(const RunRecord& record);
/// How far the best design stays from each limit, on the search's mesh and on finer ones; empty without the latter.
[[nodiscard]] std::string limit_table(const RunRecord& record);

/// How far start and best design hold where something is other than the study says; empty where nobody asked.
[[nodiscard]] std::string departure_table(const RunRecord& record);

/// Every candidate, collapsed.
[[nodiscard]] std::string evaluation_table(const RunRecord& record);

/// Versions, options and the study's text.
[[nodiscard]] std::string provenance_section(const RunRecord& record);

/// The verified designs: worn volume and depth by the direct method and by the history.
[[nodiscard]] std::string verification_table(const RunRecord& record);

}  // namespace dovetail::report
