#pragma once

#include <string_view>

#include "core/enum_names.hpp"

namespace dovetail::contact {

/// How slip over one sample is integrated.
enum class SlipReturn {
  first_order,   ///< backward Euler, as in [Salles 2009, eq. 15-19]
  second_order,  ///< rotates the previous slip direction (in space) and starts contact between samples
};
constexpr EnumNames<SlipReturn, 2> enum_names(SlipReturn) {
  return {{{SlipReturn::first_order, "first_order"}, {SlipReturn::second_order, "second_order"}}};
}
[[nodiscard]] constexpr std::string_view to_string(SlipReturn rule) {
  return name_of(rule);
}

}  // namespace dovetail::contact
