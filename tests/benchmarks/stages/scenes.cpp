#include "tests/benchmarks/stages/scenes.hpp"

#include <algorithm>
#include <array>

#include "studies/program/study_file/study.hpp"

namespace dovetail::benchmarks {

namespace {

using optimizer::Scene;

Scene quickstart(int edges_per_flank) {
  Scene scene = studies::load_study(QUICKSTART).scene;
  scene.mesh.flank_elements = edges_per_flank;
  return scene;
}

Scene flanks_changed() {
  Scene scene = quickstart(24);
  scene.solver.prestress = optimizer::Prestress::shared;
  optimizer::set_parameter(scene, "geometry.flank_mismatch_um", 8);
  optimizer::set_parameter(scene, "geometry.flank_crown_um", 2);
  optimizer::set_parameter(scene, "contact.friction", 0.45);
  return scene;
}

Scene sector() {
  return studies::load_study(BLADED_DISK).scene;
}

Scene coarse_sector() {
  Scene scene = sector();
  scene.mesh.flank_elements = 6;
  scene.mesh.fillet_fraction = 1;
  scene.mesh.bulk_size = 20e-3;
  scene.mesh.aerofoil_elements = 4;
  scene.mesh.blend_fraction = 1;
  scene.mesh.growth = 1;
  scene.solid_mesh.slot_elements = 4;
  scene.solid_mesh.contact_slot_elements = 4;
  return scene;
}

/// Another mesh on the same topology.
void change_mesh(Scene& scene) {
  scene.geometry.neck_width *= 1.001;
}

/// The start of the quickstart: the same mesh.
void change_flanks(Scene& scene) {
  optimizer::set_parameter(scene, "geometry.flank_mismatch_um", 0);
  optimizer::set_parameter(scene, "geometry.flank_crown_um", 0);
  optimizer::set_parameter(scene, "contact.friction", 0.5);
}

constexpr std::array<BenchmarkScene, 5> kScenes{{
    {"section_34", "start of the quickstart, 24 edges per flank", [] { return quickstart(24); }, change_mesh, false},
    {"section_112", "the same with 192 edges per flank", [] { return quickstart(192); }, change_mesh, false},
    {"section_flank_only", "the first with other flanks and friction: matrices are there from the design before",
     flanks_changed, change_flanks, false},
    {"sector_coarse", "the bladed disk in space on a coarse mesh", coarse_sector, change_mesh, false},
    {"sector", "the bladed disk in space as its study has it", sector, change_mesh, true},
}};

}  // namespace

std::span<const BenchmarkScene> benchmark_scenes() {
  return kScenes;
}

const BenchmarkScene* find_scene(std::string_view name) {
  const auto found = std::ranges::find(kScenes, name, &BenchmarkScene::name);
  return found == kScenes.end() ? nullptr : &*found;
}

}  // namespace dovetail::benchmarks
