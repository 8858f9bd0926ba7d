#include "studies/program/answers/geometry_export.hpp"

#include <cassert>

#include "core/replace_file.hpp"
#include "geometry/exports/dxf.hpp"
#include "geometry/exports/inp.hpp"
#include "geometry/exports/layer.hpp"
#include "geometry/exports/stl.hpp"
#include "geometry/exports/svg.hpp"
#include "geometry/solid/solid_family.hpp"
#include "optimizer/candidate/candidate_model.hpp"
#include "optimizer/scene/scene_kind.hpp"
#include "studies/program/study_file/export.hpp"
#include "studies/program/study_file/refusal.hpp"

namespace dovetail::studies {

namespace {

/// Throws InputError when the design cannot be meshed.
geometry::MeshedSector meshed(const optimizer::Scene& scene) {
  geometry::MeshedSector mesh = scene.kind->mesher(scene)(scene);
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

}  // namespace

void export_geometry(const optimizer::Scene& scene, const std::string& format, const DeckOptions& deck,
                     const std::filesystem::path& file) {
  assert(is_export_format(format) && !is_field_format(format));
  if (needs_space(format) && !scene.kind->in_space)
    refuse("scene.type", "must be sector for " + format + ": a section has no surface in space",
           std::string(scene.kind->name));
  if (is_deck_format(format))
    export_deck(scene, deck, file);
  else if (format == "stl")
    replace_file(file, geometry::stl(meshed(scene).sector.mesh, {0, 1}));
  else if (format == "dxf")
    geometry::write_dxf(file, geometry::section_layers(scene.geometry));
  else
    geometry::write_svg(file, geometry::section_layers(scene.geometry));
}

}  // namespace dovetail::studies
