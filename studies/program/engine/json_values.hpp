#pragma once

#include <functional>
#include <string>
#include <utility>

#include "optimizer/journal/record_json.hpp"
#include "steady/options.hpp"

namespace dovetail::optimizer {

/// The settings that every answer states.
template <>
inline constexpr auto kFields<steady::Options> =
    std::tuple{RecordField{"harmonics", &steady::Options::harmonics}, RecordField{"samples", &steady::Options::samples},
               RecordField{"tolerance", &steady::Options::tolerance}, RecordField{"solver", &steady::Options::solver}};

}  // namespace dovetail::optimizer

// Answers as JSON: a number that is not finite does not exist and is null.
namespace dovetail::studies {

using Json = nlohmann::ordered_json;

/// Of a number, text, list, matrix, map, optional value, enumeration or record; see optimizer::json_value.
template <class T>
[[nodiscard]] Json json_of(const T& value) {
  return optimizer::json_value<Json>(value);
}

/// A key and what a row of a table has under it: a member, or a function of the row.
template <class Entry>
struct Column {
  constexpr Column(const char* column_key, Entry of_row) : key(column_key), entry(std::move(of_row)) {}

  const char* key;
  Entry entry;
};

/// Adds a list for each column, with one entry per row.
template <class Rows, class... Entries>
void add_columns(Json& json, const Rows& rows, const Column<Entries>&... columns) {
  ((json[columns.key] = Json::array()), ...);
  for (const auto& row : rows) (json[columns.key].push_back(json_of(std::invoke(columns.entry, row))), ...);
}

/// The text of a document, ending with a newline.
[[nodiscard]] inline std::string text(const Json& json) {
  return json.dump(1, ' ', false, nlohmann::detail::error_handler_t::replace) + "\n";
}

}  // namespace dovetail::studies
