#pragma once

#include <string_view>

#include "core/enum_names.hpp"

namespace dovetail::wear {

/// What drives the wear.
enum class Follow {
  fixed,      ///< the frequency stays that of the start
  resonance,  ///< the frequency is the resonance of the joint as worn so far
};
constexpr EnumNames<Follow, 2> enum_names(Follow) {
  return {{{Follow::fixed, "fixed"}, {Follow::resonance, "resonance"}}};
}
[[nodiscard]] constexpr std::string_view to_string(Follow follow) {
  return name_of(follow);
}

}  // namespace dovetail::wear
