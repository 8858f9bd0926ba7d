#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <type_traits>
#include <vector>

namespace dovetail {

/// A value of an enumeration and the word for it in study files, JSON and messages.
template <class E>
struct EnumName {
  E value;
  std::string_view name;
};

/// All values of E. An enumeration that is written or read by name has one such table, in a function beside it:
///
///     enum class Follow { fixed, resonance };
///     constexpr EnumNames<Follow, 2> enum_names(Follow) {
///       return {{{Follow::fixed, "fixed"}, {Follow::resonance, "resonance"}}};
///     }
///     constexpr std::string_view to_string(Follow follow) { return name_of(follow); }
template <class E, std::size_t N>
using EnumNames = std::array<EnumName<E>, N>;

template <class E>
concept NamedEnum = std::is_enum_v<E> && requires {
  enum_names(E{});
};

/// Whether every entry of the table has a name, and none a value or name of another. A value without an entry it cannot
/// notice; to_string() calls that one "unknown".
template <NamedEnum E>
[[nodiscard]] constexpr bool well_named() {
  constexpr auto names = enum_names(E{});
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i].name.empty()) return false;
    for (std::size_t k = 0; k < i; ++k)
      if (names[i].value == names[k].value || names[i].name == names[k].name) return false;
  }
  return true;
}

/// The word for a value; "unknown" for a number that is none.
template <NamedEnum E>
[[nodiscard]] constexpr std::string_view name_of(E value) {
  for (const EnumName<E>& entry : enum_names(value))
    if (entry.value == value) return entry.name;
  return "unknown";
}

/// The value with that name; nothing when there is none.
template <NamedEnum E>
[[nodiscard]] constexpr std::optional<E> named(std::string_view name) {
  static_assert(well_named<E>(), "the table of the enumeration is incomplete");
  for (const EnumName<E>& entry : enum_names(E{}))
    if (entry.name == name) return entry.value;
  return std::nullopt;
}

/// The names of all values in the order of their table.
template <NamedEnum E>
[[nodiscard]] std::vector<std::string_view> names_of() {
  std::vector<std::string_view> names;
  for (const EnumName<E>& entry : enum_names(E{})) names.push_back(entry.name);
  return names;
}

}  // namespace dovetail
