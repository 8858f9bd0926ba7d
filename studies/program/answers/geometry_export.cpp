#include "studies/program/answers/geometry_export.hpp"

#include <fmt/format.h>

#include <cassert>

#include "geometry/exports/dxf.hpp"
#include "geometry/exports/inp.hpp"
#include "geometry/exports/layer.hpp"
#include "geometry/exports/svg.hpp"
#include "geometry/solid/solid_family.hpp"
#include "optimizer/candidate/candidate_model.hpp"
#include "optimizer/scene/scene_kind.hpp"
#include "studies/program/answers/solid_export.hpp"
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
  for (const int diameter : options.nodal_diameters)
    if (const int most = scene.geometry.sectors / 2; diameter < 0 || diameter > most)
      refuse("--nodal-diameter", fmt::format("must be 0 to {} of {} sectors", most, scene.geometry.sectors),
             std::to_string(diameter));
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

void export_geometry(const optimizer::Scene& scene, ExportFormat format, const DeckOptions& deck,
                     const std::filesystem::path& file) {
  switch (format) {
    case ExportFormat::dxf:
      return geometry::write_dxf(file, geometry::section_layers(scene.geometry));
    case ExportFormat::svg:
      return geometry::write_svg(file, geometry::section_layers(scene.geometry));
    case ExportFormat::step:
    case ExportFormat::iges:
    case ExportFormat::stl:
      return export_solids(scene, format, nullptr, file);
    case ExportFormat::inp:
      return export_deck(scene, deck, file);
    case ExportFormat::vtu:
    case ExportFormat::pvd:
    case ExportFormat::csv:
      assert(false && "computed, see field_export.hpp and candidate_table.hpp");
  }
}

}  // namespace dovetail::studies
