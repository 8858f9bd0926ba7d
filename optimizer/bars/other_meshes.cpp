#include "optimizer/bars/other_meshes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dovetail::optimizer {

namespace {

void set_within_range(Scene& scene, const char* key, double value) {
  const Range& range = find_parameter(key)->range;
  set_parameter(scene, key, std::clamp(value, range.lower, range.upper));
}

}  // namespace

Scene resized_section(Scene scene, double ratio) {
  for (const char* key : {"mesh.fillet_fraction", "mesh.blend_fraction", "mesh.bulk_size_mm"})
    set_within_range(scene, key, ratio * parameter(scene, key));
  return scene;
}

Scene resized(Scene scene, double ratio) {
  const auto fewer = [&](const char* key) {
    const double count = parameter(scene, key);
    if (count > 0)
      set_within_range(scene, key, std::max(2.0, std::round(count / ratio)));  // 0: as many as the mesh has
  };
  fewer("mesh.flank_elements");
  fewer("mesh.aerofoil_elements");
  if (!scene.in_space()) return resized_section(std::move(scene), ratio);
  for (const char* key : {"mesh.slot_elements", "mesh.contact_slot_elements", "mesh.contact_flank_elements"})
    fewer(key);
  return scene;
}

OtherMeshes::OtherMeshes(const Scene& reference) {
  const std::vector<double> ratios =
      reference.in_space() ? std::vector<double>{1.5, 2} : std::vector<double>{1 / 1.5, 1.5};
  for (const double ratio : ratios)
    meshes_.push_back({.ratio = ratio, .builder = ModelBuilder(resized(reference, ratio))});
  if (reference.in_space()) finer_section_.emplace(resized_section(reference, kSectionRatio));
}

}  // namespace dovetail::optimizer
