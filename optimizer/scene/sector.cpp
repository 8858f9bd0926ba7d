#include <memory>

#include "fem/assembly.hpp"
#include "geometry/solid/solid_family.hpp"
#include "optimizer/scene/scene_kind.hpp"

namespace dovetail::optimizer {

namespace {

Mesher mesher(const Scene& reference) {
  const auto family =
      std::make_shared<const geometry::SolidFamily>(reference.geometry, reference.mesh, reference.solid_mesh);
  return [family](const Scene& scene) { return family->mesh_of(scene.geometry, scene.solid); };
}

constexpr std::array<std::string_view, 5> kCounts{"mesh.flank_elements", "mesh.aerofoil_elements", "mesh.slot_elements",
                                                  "mesh.contact_slot_elements", "mesh.contact_flank_elements"};
constexpr std::array<std::string_view, 2> kLayers{"mesh.slot_elements", "mesh.contact_slot_elements"};

geometry::Feasibility feasibility(const Scene& scene, const geometry::FeasibilityLimits& limits) {
  return geometry::check_feasibility(scene.geometry, scene.solid, limits);
}

double blade_mass(const Scene& scene, const fem::Mesh& mesh) {
  return fem::body_mass(mesh, materials(scene), 0);
}

std::vector<Violation> too_fine(const Scene& scene) {
  return geometry::contradictions(scene.solid_mesh, scene.mesh);
}

}  // namespace

const SceneKind kSector{.name = "sector",
                        .meaning = "the sector in space",
                        .feasibility = feasibility,
                        .mesher = mesher,
                        .blade_mass = blade_mass,
                        .contradictions = too_fine,
                        .counts = kCounts,
                        .layers = kLayers,
                        .beside = {},
                        .lengths = {},     // the section beside the flanks is as coarse as elements of the sweep allow
                        .finer_below = 0,  // a finer one would cost more than all else
                        .contact_grid = true,
                        .rough_peaks = false,     // not measured at the corners of rough flanks
                        .coarse_answers = false,  // two or three cells in a worn zone come and go with the harmonics
                        .in_space = true,
                        .finer_meshes = 1};  // four times as fine costs hours

}  // namespace dovetail::optimizer
