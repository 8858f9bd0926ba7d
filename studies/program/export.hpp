#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "optimizer/scene.hpp"
#include "studies/program/deck_export.hpp"

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

/// Writes a scene in a format without computed fields: the section as a drawing, the surfaces of blade and disk in
/// space, or an input deck. Throws InputError for a file that cannot be written, a design that cannot be meshed where
/// the format needs a mesh, and a section where it needs a solid.
void export_geometry(const optimizer::Scene& scene, const std::string& format, const DeckOptions& deck,
                     const std::filesystem::path& file);

}  // namespace dovetail::studies
