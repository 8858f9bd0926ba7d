#include "studies/program/export.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <vector>

#include "geometry/exports/dxf.hpp"
#include "geometry/exports/layer.hpp"
#include "geometry/exports/svg.hpp"

namespace dovetail::studies {

std::span<const std::string_view> export_formats() {
  static constexpr std::array<std::string_view, 4> formats{"dxf", "svg", "vtu", "inp"};
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

void export_section(const optimizer::Scene& scene, const std::string& format, const std::filesystem::path& file) {
  assert(is_export_format(format) && !is_field_format(format) && !is_deck_format(format));
  const std::vector<geometry::Layer> layers = geometry::section_layers(scene.geometry);
  if (format == "dxf")
    geometry::write_dxf(file, layers);
  else
    geometry::write_svg(file, layers);
}

}  // namespace dovetail::studies
