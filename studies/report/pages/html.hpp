#pragma once

#include <string>
#include <string_view>

namespace dovetail::report {

/// Text for HTML and XML, in elements and in quoted attributes: & < > " ' escaped, control characters that XML
/// forbids and bytes that are no UTF-8 replaced by U+FFFD.
[[nodiscard]] std::string escape(std::string_view text);

}  // namespace dovetail::report
