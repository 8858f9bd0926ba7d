#include "optimizer/bars/other_meshes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

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

std::vector<double> layers(const Scene& scene) {
  std::vector<double> counts;
  for (const std::string_view key : scene.kind->layers) counts.push_back(parameter(scene, key));
  return counts;
}

}  // namespace

Scene resized_section(Scene scene, double ratio) {
  return lengthened(std::move(scene), kSection.lengths, ratio);
}

Scene with_few_layers(Scene scene) {
  for (const std::string_view key : scene.kind->layers) {
    const double count = parameter(scene, key);
    if (count > CompanionParams{}.section_layers) set_parameter(scene, key, CompanionParams{}.section_layers);
  }
  return scene;
}

Scene resized(Scene scene, double ratio) {
  return resized(std::move(scene), ratio, ratio);
}

Scene resized(Scene scene, double ratio, double beside) {
  const SceneKind& kind = *scene.kind;
  for (const std::string_view key : kind.counts) {
    const double count = parameter(scene, key), times = std::ranges::count(kind.beside, key) > 0 ? beside : ratio;
    if (count > 0)
      set_within_range(scene, key, std::max(2.0, std::round(count / times)));  // 0: as many as the mesh has
  }
  return lengthened(std::move(scene), kind.lengths, beside);
}

OtherMeshes::OtherMeshes(const Scene& reference, bool finer) {
  constexpr CompanionParams kParams;
  const int below = reference.kind->finer_below;  // 0: none is ever asked
  const bool coarsest =
      resized(reference, kParams.coarser.front()).mesh.flank_elements == reference.mesh.flank_elements;
  const bool ask_finer = coarsest || reference.mesh.flank_elements < below || (finer && below > 0);
  for (const double ratio : ask_finer ? kParams.finer : kParams.coarser)
    meshes_.push_back({.ratio = ratio, .builder = ModelBuilder(resized(reference, ratio))});
  if (!reference.kind->lengths.empty()) return;
  const Scene few = with_few_layers(reference);
  sections_ = {.own = {}, .finer = ModelBuilder(resized_section(few, kParams.section_ratio))};
  if (layers(few) != layers(reference)) sections_->own.emplace(few);
}

}  // namespace dovetail::optimizer
