#include <memory>

#include "geometry/profile/measures.hpp"
#include "optimizer/scene/scene_kind.hpp"

namespace dovetail::optimizer {

namespace {

Mesher mesher(const Scene& reference) {
  const auto family = std::make_shared<const geometry::MeshFamily>(reference.geometry, reference.mesh);
  return [family](const Scene& scene) { return family->mesh_of(scene.geometry); };
}

// The orders were chosen while looking at random designs against meshes four times as fine (studies/error_bars, seeds
// 1 and 2).
double mesh_order(std::string_view response) {
  // Forces that follow from equilibrium know of the mesh only through its quadratic arcs.
  if (response == "contact_pressure_mean_pa" || response == "neck_tension_pa") return 2;
  // Stresses of fillets, for which what the free surface says of them counts besides.
  if (response.ends_with("_fillet_stress_pa")) return 2.8;
  if (response == "peak_stress_pa") return 1.3;
  // Most of the worn joint bears on its inner parts.
  if (response == "resonance_drift") return 2.5;
  if (response == "asymptotic_wear_depth_max_m") return 2;
  // Slip next to the sharp ends of flanks, and the wear that comes of it.
  if (response == "dissipated_energy_j" || response == "initial_wear_rate_m3_per_cycle" ||
      response == "peak_amplitude_m")
    return 1.6;
  // Frequencies, worn amplitude and volume.
  return 1.5;
}

constexpr std::array<std::string_view, 2> kCounts{"mesh.flank_elements", "mesh.aerofoil_elements"};
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
                         .mesh_order = mesh_order,
                         .counts = kCounts,
                         .lengths = kLengths,
                         .other_meshes = {1 / 1.5, 1.5},
                         .contact_grid = false,
                         .rough_peaks = true,
                         .coarse_answers = true,
                         .surface = false};

}  // namespace dovetail::optimizer
