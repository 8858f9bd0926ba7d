#pragma once

#include <string>

#include "optimizer/journal.hpp"

namespace dovetail::optimizer {

/// One line of JSON text. Doubles read back bit by bit; NaN and infinities are the strings "nan", "inf", "-inf" (the
/// payload and sign of a NaN are not kept). Bytes that are no UTF-8 are replaced by U+FFFD.
[[nodiscard]] std::string record_text(std::size_t index, const JournalRecord& record);

/// Reads what record_text wrote. Throws std::runtime_error with a reason when the text is something else.
[[nodiscard]] JournalRecord record_from_text(const std::string& text, std::size_t expected_index);

}  // namespace dovetail::optimizer
