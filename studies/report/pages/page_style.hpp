#pragma once

#include <string>

namespace dovetail::report {

/// A page up to its first element: head with the title, the style of text, tables and figures and these rules besides,
/// body and main opened.
[[nodiscard]] std::string page_begin(const std::string& title, const std::string& rules = {});
inline constexpr const char* kPageEnd = "</main></body></html>\n";

}  // namespace dovetail::report
