#include <memory>

#include "geometry/profile/measures.hpp"
#include "optimizer/scene/scene_kind.hpp"

namespace dovetail::optimizer {

namespace {

Mesher mesher(const Scene& reference) {
  const auto family = std::make_shared<const geometry::MeshFamily>(reference.geometry, reference.mesh);
  return [family](const Scene& scene) { return family->mesh_of(scene.geometry); };
}

constexpr std::array<std::string_view, 2> kCounts{"mesh.flank_elements", "mesh.aerofoil_elements"};
constexpr std::array<std::string_view, 1> kBeside{"mesh.aerofoil_elements"};
constexpr std::array<std::string_view, 3> kLengths{"mesh.fillet_fraction", "mesh.blend_fraction", "mesh.bulk_size_mm"};

geometry::Feasibility feasibility(const Scene& scene, const geometry::FeasibilityLimits& limits) {
  return geometry::check_feasibility(scene.geometry, limits);
}

double blade_mass(const Scene& scene, const fem::Mesh&) {
  return geometry::mass(scene.geometry, scene.blade.density, scene.disk.density).blade;
}

}  // namespace

const SceneKind kSection{.name = "section",
                         .meaning = "a plane section of one sector",
                         .feasibility = feasibility,
                         .mesher = mesher,
                         .blade_mass = blade_mass,
                         .contradictions = [](const Scene&) { return std::vector<Violation>{}; },
                         .counts = kCounts,
                         .layers = {},
                         .beside = kBeside,
                         .lengths = kLengths,
                         .finer_below = 48,  // measured from there on (studies/error_bars)
                         .contact_grid = false,
                         .rough_peaks = true,
                         .coarse_answers = true,
                         .in_space = false};

}  // namespace dovetail::optimizer
