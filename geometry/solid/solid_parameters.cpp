#include "geometry/solid/solid_parameters.hpp"

#include <array>
#include <numbers>
#include <utility>
#include <vector>

namespace dovetail {

namespace {

constexpr double kMillimetre = 1e-3;
constexpr double kMicrometre = 1e-6;
constexpr double kDegree = std::numbers::pi / 180.0;

using S = geometry::SolidParameters;
using Z = geometry::SolidSizes;

const auto& solid_fields() {
  static const std::array fields{
      Field<S>{"skew_angle_deg",
               &S::skew_angle,
               kDegree,
               {.lower = -30, .upper = 30},
               "Angle between the slot and the axis of rotation; the section is that of the planes across the axis."},
      Field<S>{"stagger_deg",
               &S::stagger,
               kDegree,
               {.lower = -60, .upper = 60},
               "Angle between the chord at the aerofoil's root and the axis of rotation."},
      Field<S>{"twist_deg",
               &S::twist,
               kDegree,
               {.lower = -75, .upper = 75},
               "Turn of the chord from the aerofoil's root to its tip, linear along the span."},
      Field<S>{"tip_chord_mm",
               &S::tip_chord,
               kMillimetre,
               {.lower = 0, .upper = 5000},
               "Chord at the tip, linear from chord_mm at the root; 0: chord_mm."},
      Field<S>{"lean_mm",
               &S::lean,
               kMillimetre,
               {.lower = -500, .upper = 500},
               "Tangential offset of the aerofoil's tip, growing with the square of the distance from its root."},
      Field<S>{"edge_thickness_fraction",
               &S::edge_thickness_fraction,
               1,
               {.lower = 0.1, .upper = 1},
               "Thickness of the aerofoil at its leading and trailing edge over that in mid-chord; 1: a plate."},
      Field<S>{"axial_crown_um",
               &S::axial_crown,
               kMicrometre,
               {.lower = -500, .upper = 500},
               "Height of the blade flanks' bulge in the middle of the slot; negative: hollow."},
      Field<S>{"axial_relief_length_mm",
               &S::axial_relief_length,
               kMillimetre,
               {.lower = 0, .upper = 1000},
               "Length of the relieved zone at each end of the slot."},
      Field<S>{"axial_relief_depth_um",
               &S::axial_relief_depth,
               kMicrometre,
               {.lower = 0, .upper = 500},
               "Depth of the relief at the ends of the slot."},
  };
  return fields;
}

const auto& size_fields() {
  static const std::array fields{
      Field<Z>{"slot_elements",
               &Z::slot_elements,
               1,
               {.lower = 2, .upper = 500},
               "Layers of elements along the slot (solid sector only)."},
      Field<Z>{"slot_grading",
               &Z::slot_grading,
               1,
               {.lower = 0.1, .upper = 1},
               "Size of the layers at the slot's ends over that in its middle; 1: all equal (solid sector only)."},
      Field<Z>{"contact_flank_elements",
               &Z::contact_flank_elements,
               1,
               {.lower = 0, .upper = 2000},
               "Parts between contact nodes across the slot, at most flank_elements; 0: as many (solid sector only)."},
      Field<Z>{"contact_slot_elements",
               &Z::contact_slot_elements,
               1,
               {.lower = 0, .upper = 500},
               "Parts between contact nodes along the slot, at most slot_elements; 0: as many (solid sector only)."},
  };
  return fields;
}

}  // namespace

template <>
std::span<const Field<S>> option_table<S>() {
  return solid_fields();
}
template <>
std::span<const Field<Z>> option_table<Z>() {
  return size_fields();
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
