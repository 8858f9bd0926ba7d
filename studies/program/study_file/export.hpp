#pragma once

#include <string>
#include <string_view>

#include "core/enum_names.hpp"

namespace dovetail::studies {

/// Formats of the section [export] and of the command export.
enum class ExportFormat {
  dxf,   ///< drawing of the section
  svg,   ///< drawing of the section
  step,  ///< solids of blade and disk
  iges,  ///< the same
  stl,   ///< their surfaces in triangles
  vtu,   ///< computed fields on the mesh
  pvd,   ///< a series of these: the joint while it wears
  csv,   ///< table of all candidates of a run
  inp,   ///< the finite elements themselves, an input deck of another program
};
constexpr EnumNames<ExportFormat, 9> enum_names(ExportFormat) {
  return {{{ExportFormat::dxf, "dxf"},
           {ExportFormat::svg, "svg"},
           {ExportFormat::step, "step"},
           {ExportFormat::iges, "iges"},
           {ExportFormat::stl, "stl"},
           {ExportFormat::vtu, "vtu"},
           {ExportFormat::pvd, "pvd"},
           {ExportFormat::csv, "csv"},
           {ExportFormat::inp, "inp"}}};
}
/// Whether what is written has to be computed, or to be read from a run.
[[nodiscard]] constexpr bool has_fields(ExportFormat format) {
  return format == ExportFormat::vtu || format == ExportFormat::pvd;
}
/// Solids may be drawn with worn flanks.
[[nodiscard]] constexpr bool is_solid(ExportFormat format) {
  return format == ExportFormat::step || format == ExportFormat::iges || format == ExportFormat::stl;
}
[[nodiscard]] constexpr std::string_view to_string(ExportFormat format) {
  return name_of(format);
}

/// "dxf, svg, ..."
[[nodiscard]] inline std::string export_formats() {
  std::string text;
  for (const std::string_view format : names_of<ExportFormat>()) text.append(text.empty() ? "" : ", ").append(format);
  return text;
}

}  // namespace dovetail::studies
