#pragma once

#include "core/options.hpp"
#include "geometry/profile/parameters.hpp"

namespace dovetail::geometry {

/// What the solid sector has beyond its section, SI. With the defaults (and chord = slot length) it is the section
/// of profile.hpp extruded along the axis of rotation. z is axial, z = 0 the middle of the slot; angles are positive
/// from +z towards +x.
struct SolidParameters {
  double skew_angle = 0;  ///< between the slot and the axis of rotation (broach angle), rad; the section is that of
                          ///< the transverse planes z = const, not normal to the slot
  double stagger = 0;     ///< of the aerofoil's chord against the axis at its root, rad
  double twist = 0;       ///< further turn of the chord from root to tip, linear along the span, rad
  double tip_chord = 0;   ///< m, linear from ProfileParameters::chord at the root; 0: no taper
  double lean = 0;        ///< tangential offset of the tip, m; square of the distance from the aerofoil's root
  double edge_thickness_fraction = 1;  ///< thickness at leading and trailing edge over that in mid-chord; parabola
  double axial_crown = 0;              ///< height of the blade flanks' bulge in the middle of the slot, m
  double axial_relief_length = 0;      ///< length, along the slot, of the relieved zone at each of its ends, m
  double axial_relief_depth = 0;       ///< depth of that relief at the slot's ends, m
};

/// Division of the solid along the slot and of the contact on it.
struct SolidSizes {
  int slot_elements = 8;           ///< layers of elements along the slot
  double slot_grading = 1;         ///< size of a layer at the slot's ends over one in the middle
  int contact_flank_elements = 0;  ///< parts of a flank between contact nodes, across the slot; 0: one per element
  int contact_slot_elements = 0;   ///< the same along the slot
};

/// Tapered or not: the chord at the tip, m.
[[nodiscard]] double tip_chord(const ProfileParameters& parameters, const SolidParameters& solid);

/// Throws InputError when a parameter is out of range.
const SolidParameters& checked(const SolidParameters& solid);
/// A contact grid finer than the mesh.
[[nodiscard]] std::vector<Violation> contradictions(const SolidSizes& sizes, const MeshSizes& section);
/// Throws InputError when a size is out of range or the contact grid is finer than the mesh.
const SolidSizes& checked(const SolidSizes& sizes, const MeshSizes& section);

}  // namespace dovetail::geometry

namespace dovetail {

/// Keys of the study file: [geometry] and [mesh].
template <>
[[nodiscard]] std::span<const Field<geometry::SolidParameters>> option_table<geometry::SolidParameters>();
template <>
[[nodiscard]] std::span<const Field<geometry::SolidSizes>> option_table<geometry::SolidSizes>();

}  // namespace dovetail
