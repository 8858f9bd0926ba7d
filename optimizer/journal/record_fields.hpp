#pragma once

#include <string>
#include <tuple>

/// @file
/// One table of fields per record, for JSON and journal (record_json.hpp), results (results_archive.hpp) and help.
namespace dovetail::optimizer {

/// A field of the record R: its name where it is written, with its SI unit, and the member.
template <class R, class T>
struct RecordField {
  constexpr RecordField(const char* written_name, T R::*of_record, bool since_later = false)
      : name(written_name), member(of_record), later(since_later) {}

  const char* name;
  T R::*member;
  bool later;  ///< files of older versions do not have it
};

/// The fields of R in the order they are written. Specialise for each record:
/// `template <> inline constexpr auto kFields<X> = std::tuple{RecordField{"mass_kg", &X::mass}, ...};`
template <class R>
inline constexpr auto kFields = std::tuple<>{};

template <class R>
concept Record = std::tuple_size_v<decltype(kFields<R>)> >
0;

/// Calls `visit` with every field of R.
template <Record R, class Visit>
void each_field(Visit&& visit) {
  std::apply([&](const auto&... field) { (visit(field), ...); }, kFields<R>);
}

/// The names in quotes, separated by commas, in lines for a terminal.
template <Record R>
[[nodiscard]] std::string listed_keys() {
  constexpr std::size_t kWidth = 100;
  std::string text;
  each_field<R>([&](const auto& field) {
    const std::string name = '"' + std::string(field.name) + '"';
    const std::size_t column = text.size() - (text.rfind('\n') + 1);
    text += (text.empty() ? "" : column + name.size() > kWidth ? ",\n" : ", ") + name;
  });
  return text;
}

}  // namespace dovetail::optimizer
