#pragma once

#include <string>
#include <string_view>

#include "core/enum_names.hpp"

namespace dovetail::studies {

/// Formats of the section [export] and of the command export.
enum class ExportFormat {
  dxf,  ///< drawing of the section
  svg,  ///< drawing of the section
  stl,  ///< surfaces in space: a section has nothing to write
  vtu,  ///< computed fields on the mesh
  inp,  ///< the finite elements themselves, an input deck of another program
};
constexpr EnumNames<ExportFormat, 5> enum_names(ExportFormat) {
  return {{{ExportFormat::dxf, "dxf"},
           {ExportFormat::svg, "svg"},
           {ExportFormat::stl, "stl"},
           {ExportFormat::vtu, "vtu"},
           {ExportFormat::inp, "inp"}}};
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
