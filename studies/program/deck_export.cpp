#include "studies/program/deck_export.hpp"

#include "geometry/exports/inp.hpp"
#include "geometry/solid_family.hpp"
#include "optimizer/candidate_model.hpp"
#include "studies/program/refusal.hpp"

namespace dovetail::studies {

geometry::MeshedSector meshed(const optimizer::Scene& scene) {
  geometry::MeshedSector mesh = scene.in_space()
                                    ? geometry::mesh_solid(scene.geometry, scene.solid, scene.mesh, scene.solid_mesh)
                                    : geometry::mesh_sector(scene.geometry, scene.mesh);
  if (mesh.quality.inverted_elements > 0) refuse("geometry", "cannot be meshed: " + mesh.note);
  return mesh;
}

void export_deck(const optimizer::Scene& scene, const DeckOptions& options, const std::filesystem::path& file) {
  geometry::InpOptions deck{.joint = options.contact ? geometry::FlankJoint::contact : geometry::FlankJoint::glued,
                            .friction = scene.contact.friction,
                            .speed = scene.loading.speed,
                            .nodal_diameters = options.nodal_diameters.empty()
                                                   ? std::vector{scene.loading.nodal_diameter}
                                                   : options.nodal_diameters,
                            .modes = options.modes};
  // Rough flanks give way as the pairs of a deck do; rigid ones take the deck's own, stiff enough.
  if (scene.contact.normal_stiffness > 0) deck.contact_stiffness = scene.contact.normal_stiffness;
  if (scene.contact.tangential_stiffness > 0) deck.stick_stiffness = scene.contact.tangential_stiffness;
  geometry::write_inp(file, meshed(scene).sector, optimizer::materials(scene), deck);
}

}  // namespace dovetail::studies
