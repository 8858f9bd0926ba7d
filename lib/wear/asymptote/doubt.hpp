#pragma once

#include <string_view>

#include "core/enum_names.hpp"

namespace dovetail::wear {

/// Why the direct answer may not be where wear ends, in the order in which it is looked for.
enum class Doubt {
  none,
  nothing_holds,
  pass_failed,
  certificate,
  threshold,
  gross_sliding,
  reload,
  lift_off,
  worst_first,
  on_the_way,
  near_slip,
  always,
  finer_settings,
  unfinished,
};

/// What a doubt means, and who settles it.
struct DoubtEntry {
  Doubt doubt;
  std::string_view name;
  std::string_view meaning;  ///< after "in doubt: "
  /// The direct answer stands, in doubt, until someone asks the history; otherwise the history alone can give one.
  bool direct_stands;
};
[[nodiscard]] const DoubtEntry& entry(Doubt doubt);

/// "" for none.
[[nodiscard]] std::string_view to_string(Doubt doubt);

/// Ways to a state at rest.
enum class FoundBy {
  release,        ///< all slipping nodes at once
  worst_first,    ///< the fastest nodes first
  history,        ///< step by step
  finer_history,  ///< the same with more harmonics and samples
};
constexpr EnumNames<FoundBy, 4> enum_names(FoundBy) {
  return {{{FoundBy::release, "release"},
           {FoundBy::worst_first, "worst_first"},
           {FoundBy::history, "history"},
           {FoundBy::finer_history, "finer_history"}}};
}
[[nodiscard]] constexpr std::string_view to_string(FoundBy way) {
  return name_of(way);
}

}  // namespace dovetail::wear
