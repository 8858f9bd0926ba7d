#include "studies/program/export.hpp"

#include <array>
#include <vector>

#include "core/errors.hpp"
#include "geometry/exports/dxf.hpp"
#include "geometry/exports/layer.hpp"
#include "geometry/exports/svg.hpp"

namespace dovetail::studies {

std::span<const std::string_view> export_formats() {
  static constexpr std::array<std::string_view, 2> formats{"dxf", "svg"};
  return formats;
}

void export_scene(const optimizer::Scene& scene, const std::string& format, const std::filesystem::path& file) {
  if (format == "dxf") return geometry::write_dxf(file, geometry::section_layers(scene.geometry));
  if (format == "svg") return geometry::write_svg(file, geometry::section_layers(scene.geometry));
  std::string allowed = "must be one of";
  for (const std::string_view known : export_formats()) (allowed += ' ') += known;
  throw InputError(Violation{.file = {}, .key = "--format", .value = format, .allowed = allowed});
}

}  // namespace dovetail::studies
