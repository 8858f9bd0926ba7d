#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>

namespace dovetail::report {

/// What stands for the names of a template.
using Blanks = std::map<std::string, std::string, std::less<>>;

/// A template with its names filled in: {{name}} by a text, which is escaped, {{{name}}} by markup; what stands between
/// {{#name}} and {{/name}} is kept where there is something of that name, between {{^name}} and {{/name}} where there
/// is nothing. Throws std::out_of_range for a name that is not among the blanks.
[[nodiscard]] std::string fill(std::string_view text, const Blanks& blanks);

/// A page that needs no other file: title, the style of text, tables and figures and these rules besides, and what it
/// shows.
[[nodiscard]] std::string page(const std::string& title, std::string_view rules, const std::string& body);

}  // namespace dovetail::report
