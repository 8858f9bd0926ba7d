#pragma once

#include <string>

#include "optimizer/journal/journal.hpp"
#include "optimizer/journal/record_fields.hpp"

namespace dovetail::optimizer {

/// The keys of an evaluation in the journal and in the answer of the command evaluate.
template <>
inline constexpr auto kFields<Evaluation> = std::tuple{
    RecordField{"status", &Evaluation::status},
    RecordField{"feasible", &Evaluation::feasible},
    RecordField{"parameters", &Evaluation::parameters},
    RecordField{"responses", &Evaluation::responses},
    RecordField{"constraints", &Evaluation::constraints},
    RecordField{"error_estimates", &Evaluation::error_estimates},
    RecordField{"error_sources", &Evaluation::error_sources},
    RecordField{"unbounded", &Evaluation::unbounded},
    RecordField{"undecided_constraints", &Evaluation::undecided_constraints},
    RecordField{"model", &Evaluation::model},
    RecordField{"timings_s", &Evaluation::timings_s},
    RecordField{"messages", &Evaluation::messages},
    RecordField{"derivatives", &Evaluation::derivatives},
};

/// One line of JSON text. Doubles read back bit by bit; NaN and infinities are the strings "nan", "inf", "-inf" (the
/// payload and sign of a NaN are not kept). Bytes that are no UTF-8 are replaced by U+FFFD.
[[nodiscard]] std::string record_text(std::size_t index, const JournalRecord& record);

/// Reads what record_text wrote. Throws std::runtime_error with a reason when the text is something else.
[[nodiscard]] JournalRecord record_from_text(const std::string& text, std::size_t expected_index);

}  // namespace dovetail::optimizer
