#include "studies/program/deck_export.hpp"

#include "core/errors.hpp"
#include "geometry/exports/inp.hpp"
#include "geometry/mesh_motion.hpp"
#include "geometry/solid_family.hpp"
#include "optimizer/candidate_model.hpp"

namespace dovetail::studies {

void export_deck(const optimizer::Scene& scene, const DeckOptions& options, const std::filesystem::path& file) {
  const geometry::MeshedSector mesh =
      scene.in_space() ? geometry::mesh_solid(scene.geometry, scene.solid, scene.mesh, scene.solid_mesh)
                       : geometry::mesh_sector(scene.geometry, scene.mesh);
  if (mesh.quality.inverted_elements > 0)
    throw InputError({.file = {}, .key = "geometry", .value = {}, .allowed = "cannot be meshed: " + mesh.note});
  geometry::write_inp(file, mesh.sector, optimizer::materials(scene),
                      {.joint = options.contact ? geometry::FlankJoint::contact : geometry::FlankJoint::glued,
                       .friction = scene.contact.friction,
                       .speed = scene.loading.speed,
                       .nodal_diameters = options.nodal_diameters.empty() ? std::vector{scene.loading.nodal_diameter}
                                                                          : options.nodal_diameters,
                       .modes = options.modes});
}

}  // namespace dovetail::studies
