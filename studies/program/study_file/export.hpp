#pragma once

#include <span>
#include <string_view>

namespace dovetail::studies {

/// Formats of the section [export] and of the command export: drawings of the section (dxf, svg), the surface in space
/// (stl), fields on the mesh (vtu) and the finite elements themselves (inp).
[[nodiscard]] std::span<const std::string_view> export_formats();
[[nodiscard]] bool is_export_format(std::string_view format);
/// Whether that format holds computed fields.
[[nodiscard]] bool is_field_format(std::string_view format);
/// Whether that format is an input deck of another finite-element program.
[[nodiscard]] bool is_deck_format(std::string_view format);
/// Whether a section has nothing to write in that format.
[[nodiscard]] bool needs_space(std::string_view format);

}  // namespace dovetail::studies
