#include "geometry/solid/solid_parameters.hpp"

#include <array>
#include <utility>
#include <vector>

#include "geometry/profile/key_units.hpp"

namespace dovetail {

namespace {

using geometry::between, geometry::kDegree, geometry::kMicrometre, geometry::kMillimetre;

using S = geometry::SolidParameters;
using Z = geometry::SolidSizes;

}  // namespace

template <>
std::span<const Field<S>> option_table<S>() {
  static const std::array fields{
      Field<S>{"skew_angle_deg", &S::skew_angle, kDegree, between(-30, 30),
               "Angle between the slot and the axis of rotation; the section is that of the planes across the axis."},
      Field<S>{"stagger_deg", &S::stagger, kDegree, between(-60, 60),
               "Angle between the chord at the aerofoil's root and the axis of rotation."},
      Field<S>{"twist_deg", &S::twist, kDegree, between(-75, 75),
               "Turn of the chord from the aerofoil's root to its tip, linear along the span."},
      Field<S>{"tip_chord_mm", &S::tip_chord, kMillimetre, between(0, 5000),
               "Chord at the tip, linear from chord_mm at the root; 0: chord_mm."},
      Field<S>{"lean_mm", &S::lean, kMillimetre, between(-500, 500),
               "Tangential offset of the aerofoil's tip, growing with the square of the distance from its root."},
      Field<S>{"edge_thickness_fraction", &S::edge_thickness_fraction, 1, between(0.1, 1),
               "Thickness of the aerofoil at its leading and trailing edge over that in mid-chord; 1: a plate."},
      Field<S>{"axial_crown_um", &S::axial_crown, kMicrometre, between(-500, 500),
               "Height of the blade flanks' bulge in the middle of the slot; negative: hollow."},
      Field<S>{"axial_relief_length_mm", &S::axial_relief_length, kMillimetre, between(0, 1000),
               "Length of the relieved zone at each end of the slot."},
      Field<S>{"axial_relief_depth_um", &S::axial_relief_depth, kMicrometre, between(0, 500),
               "Depth of the relief at the ends of the slot."},
  };
  return fields;
}

template <>
std::span<const Field<Z>> option_table<Z>() {
  static const std::array fields{
      Field<Z>{"slot_elements", &Z::slot_elements, 1, between(2, 500),
               "Layers of elements along the slot (solid sector only)."},
      Field<Z>{"slot_grading", &Z::slot_grading, 1, between(0.1, 1),
               "Size of the layers at the slot's ends over that in its middle; 1: all equal (solid sector only)."},
      Field<Z>{"contact_flank_elements", &Z::contact_flank_elements, 1, between(0, 2000),
               "Parts between contact nodes across the slot, at most flank_elements; 0: as many (solid sector only)."},
      Field<Z>{"contact_slot_elements", &Z::contact_slot_elements, 1, between(0, 500),
               "Parts between contact nodes along the slot, at most slot_elements; 0: as many (solid sector only)."},
  };
  return fields;
}

namespace geometry {

double tip_chord(const ProfileParameters& parameters, const SolidParameters& solid) {
  return solid.tip_chord > 0 ? solid.tip_chord : parameters.chord;
}

const SolidParameters& checked(const SolidParameters& solid) {
  std::vector<Violation> found = violations(solid, "geometry");
  if (!found.empty()) throw InputError(std::move(found));
  return solid;
}

std::vector<Violation> contradictions(const SolidSizes& sizes, const MeshSizes& section) {
  std::vector<Violation> found;
  const auto no_finer = [&found](const char* key, int contact, const char* mesh_key, int mesh) {
    if (contact > mesh)
      found.push_back({.file = {},
                       .key = std::string("mesh.") + key,
                       .value = std::to_string(contact),
                       .allowed = "must not exceed " + std::string(mesh_key) + " (" + std::to_string(mesh) +
                                  "): the contact may be coarser than the mesh, not finer"});
  };
  no_finer("contact_flank_elements", sizes.contact_flank_elements, "flank_elements", section.flank_elements);
  no_finer("contact_slot_elements", sizes.contact_slot_elements, "slot_elements", sizes.slot_elements);
  return found;
}

const SolidSizes& checked(const SolidSizes& sizes, const MeshSizes& section) {
  std::vector<Violation> found = violations(sizes, "mesh");
  for (Violation& finer : contradictions(sizes, section)) found.push_back(std::move(finer));
  if (!found.empty()) throw InputError(std::move(found));
  return sizes;
}

}  // namespace geometry
}  // namespace dovetail
