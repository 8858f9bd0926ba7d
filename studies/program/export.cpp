#include "studies/program/export.hpp"

#include <algorithm>
#include <array>
#include <cassert>

#include "core/errors.hpp"
#include "core/replace_file.hpp"
#include "geometry/exports/dxf.hpp"
#include "geometry/exports/layer.hpp"
#include "geometry/exports/stl.hpp"
#include "geometry/exports/svg.hpp"

namespace dovetail::studies {

std::span<const std::string_view> export_formats() {
  static constexpr std::array<std::string_view, 5> formats{"dxf", "svg", "stl", "vtu", "inp"};
  return formats;
}

bool is_export_format(std::string_view format) {
  const std::span<const std::string_view> known = export_formats();
  return std::find(known.begin(), known.end(), format) != known.end();
}

bool is_field_format(std::string_view format) {
  return format == "vtu";
}

bool is_deck_format(std::string_view format) {
  return format == "inp";
}

bool needs_space(std::string_view format) {
  return format == "stl";
}

void export_geometry(const optimizer::Scene& scene, const std::string& format, const DeckOptions& deck,
                     const std::filesystem::path& file) {
  assert(is_export_format(format) && !is_field_format(format));
  if (needs_space(format) && !scene.in_space())
    throw InputError({.file = {},
                      .key = "scene.type",
                      .value = scene.type,
                      .allowed = "must be sector for " + format + ": a section has no surface in space"});
  if (is_deck_format(format))
    export_deck(scene, deck, file);
  else if (format == "stl")
    replace_file(file, geometry::stl(meshed(scene).sector.mesh, {0, 1}));
  else if (format == "dxf")
    geometry::write_dxf(file, geometry::section_layers(scene.geometry));
  else
    geometry::write_svg(file, geometry::section_layers(scene.geometry));
}

}  // namespace dovetail::studies
