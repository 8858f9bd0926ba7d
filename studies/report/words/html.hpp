#pragma once

#include <string>
#include <string_view>

namespace dovetail::report {

/// Text for HTML and XML, in elements and in quoted attributes: & < > " ' escaped, control characters that XML
/// forbids and bytes that are no UTF-8 replaced by U+FFFD.
[[nodiscard]] std::string escape(std::string_view text);

/// HTML under a line that opens it; a class of the style sheet or none.
[[nodiscard]] std::string folded(const std::string& style, const std::string& summary, const std::string& html);

}  // namespace dovetail::report
