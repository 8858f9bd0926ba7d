#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "optimizer/scene.hpp"

namespace dovetail::studies {

/// Formats of the section [export] and of the command export: drawings of the section (dxf, svg), fields on the
/// mesh (vtu) and the finite elements themselves (inp).
[[nodiscard]] std::span<const std::string_view> export_formats();
[[nodiscard]] bool is_export_format(std::string_view format);
/// Whether that format holds computed fields.
[[nodiscard]] bool is_field_format(std::string_view format);
/// Whether that format is an input deck of another finite-element program.
[[nodiscard]] bool is_deck_format(std::string_view format);

/// Writes the section of a scene as a drawing, "dxf" or "svg". Throws InputError for a file that cannot be written.
void export_section(const optimizer::Scene& scene, const std::string& format, const std::filesystem::path& file);

}  // namespace dovetail::studies
