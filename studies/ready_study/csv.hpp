#pragma once

#include <fmt/format.h>

#include <cmath>
#include <concepts>
#include <string>
#include <string_view>

#include "optimizer/journal/record_fields.hpp"

/// Lines of a table from the fields of records; see optimizer/journal/record_fields.hpp.
namespace dovetail::ready_study {

/// A text in quotes when it holds what separates.
inline std::string csv_text(std::string_view text) {
  if (text.find_first_of(",\"\n") == std::string_view::npos) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

/// A number with 17 digits, empty when it is not finite; a truth as 0 or 1.
template <class T>
std::string csv_value(const T& value) {
  if constexpr (std::is_enum_v<T>)
    return std::string(to_string(value));
  else if constexpr (std::floating_point<T>)
    return std::isfinite(value) ? fmt::format("{:.17g}", value) : "";
  else if constexpr (std::integral<T>)
    return std::to_string(value);
  else
    return csv_text(value);
}

/// The names of the fields of R, each after a comma.
template <optimizer::Record R>
std::string csv_names() {
  std::string text;
  optimizer::each_field<R>([&](const auto& field) { text += "," + std::string(field.name); });
  return text;
}

/// Their values.
template <optimizer::Record R>
std::string csv_values(const R& record) {
  std::string text;
  optimizer::each_field<R>([&](const auto& field) { text += "," + csv_value(record.*field.member); });
  return text;
}

}  // namespace dovetail::ready_study
