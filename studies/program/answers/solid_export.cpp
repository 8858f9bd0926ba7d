#include "studies/program/answers/solid_export.hpp"

#include <cassert>
#include <cmath>

#include "core/replace_file.hpp"
#include "geometry/cad/sector_solids.hpp"
#include "geometry/exports/stl.hpp"
#include "optimizer/scene/scene_kind.hpp"

namespace dovetail::studies {
namespace {

geometry::SolidDesign as_made(const optimizer::Scene& scene) {
  return {.profile = scene.geometry, .solid = scene.kind->in_space ? scene.solid : geometry::SolidParameters{}};
}

/// Contact nodes lie line by line, from the neck to the root side.
void wear_off(const report::ContactRecord& contact, geometry::SolidDesign& design) {
  const double slot = design.profile.slot_length / std::cos(design.solid.skew_angle);
  for (std::size_t i = 0; i < contact.flank.size(); ++i) {
    const std::size_t f = geometry::flank_index(contact.flank_names[static_cast<std::size_t>(contact.flank[i])]);
    const double place = contact.along_m[i] / design.profile.flanks[f].length;
    geometry::WornFlank& flank = design.worn[f];
    if (flank.empty() || place <= flank.back().places.back())
      flank.push_back({.along = contact.across_m.empty() ? 0.5 : 0.5 + contact.across_m[i] / slot});
    flank.back().places.push_back(place);
    flank.back().depth.push_back(std::max(0.0, contact.depth_m[i]));
  }
}

}  // namespace

void export_solids(const optimizer::Scene& scene, ExportFormat format, const report::ContactRecord* worn,
                   const std::filesystem::path& file) {
  assert(is_solid(format));
  geometry::SolidDesign design = as_made(scene);
  if (worn) wear_off(*worn, design);
  const geometry::SectorSolids solids(design);
  if (format == ExportFormat::step) return solids.write_step(file);
  if (format == ExportFormat::iges) return solids.write_iges(file);
  auto [triangles, disk] = solids.triangles();
  triangles.insert(triangles.end(), disk.begin(), disk.end());
  replace_file(file, geometry::stl(triangles));
}

}  // namespace dovetail::studies
