#pragma once

#include <string>
#include <string_view>

#include "core/enum_names.hpp"

namespace dovetail::studies {

/// Kinds of studies to start from.
enum class Template {
  section,  ///< a plane section, one objective
  sector,   ///< in space, on a mesh for it
  robust,   ///< several loads, and numbers that are not certain
  front,    ///< two objectives, each for itself
};
constexpr EnumNames<Template, 4> enum_names(Template) {
  return {{{Template::section, "section"},
           {Template::sector, "sector"},
           {Template::robust, "robust"},
           {Template::front, "front"}}};
}
[[nodiscard]] constexpr std::string_view to_string(Template kind) {
  return name_of(kind);
}

/// A commented study to start from: every key with its meaning, unit, range and default, made from the option tables.
/// It reads without a complaint, evaluates and may be run.
[[nodiscard]] std::string study_template(const std::string& title, Template kind = Template::section);

/// A sentence of an option table as a text of its own: with a capital letter.
[[nodiscard]] std::string capitalised(std::string_view help);

}  // namespace dovetail::studies
