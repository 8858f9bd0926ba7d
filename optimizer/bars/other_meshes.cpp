#include "optimizer/bars/other_meshes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "optimizer/bars/params.hpp"

namespace dovetail::optimizer {

namespace {

void set_within_range(Scene& scene, std::string_view key, double value) {
  const Range& range = find_parameter(key)->range;
  set_parameter(scene, key, std::clamp(value, range.lower, range.upper));
}

Scene lengthened(Scene scene, std::span<const std::string_view> keys, double ratio) {
  for (const std::string_view key : keys) set_within_range(scene, key, ratio * parameter(scene, key));
  return scene;
}

}  // namespace

Scene resized_section(Scene scene, double ratio) {
  return lengthened(std::move(scene), kSection.lengths, ratio);
}

Scene resized(Scene scene, double ratio) {
  const SceneKind& kind = *scene.kind;
  for (const std::string_view key : kind.counts) {
    const double count = parameter(scene, key);
    if (count > 0)
      set_within_range(scene, key, std::max(2.0, std::round(count / ratio)));  // 0: as many as the mesh has
  }
  return lengthened(std::move(scene), kind.lengths, ratio);
}

OtherMeshes::OtherMeshes(const Scene& reference, bool finer) {
  constexpr CompanionParams kParams;
  const int below = reference.kind->finer_below;  // 0: none is ever asked
  const bool ask_finer = reference.mesh.flank_elements < below || (finer && below > 0);
  for (const double ratio : ask_finer ? kParams.finer : kParams.coarser)
    meshes_.push_back({.ratio = ratio, .builder = ModelBuilder(resized(reference, ratio))});
  if (reference.kind->lengths.empty()) finer_section_.emplace(resized_section(reference, kParams.section_ratio));
}

}  // namespace dovetail::optimizer
