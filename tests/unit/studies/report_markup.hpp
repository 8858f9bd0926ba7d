#pragma once

#include <string>

namespace dovetail::report {

/// Empty when `text` is well-formed: every element closed in order, attributes quoted and not repeated, no bare '<' or
/// '&' in text or attributes; else what is wrong and where. <!doctype>, comments and XML declarations are skipped,
/// <style> may hold anything but "</".
[[nodiscard]] std::string markup_error(const std::string& text);

}  // namespace dovetail::report
