#pragma once

#include <numbers>

#include "geometry/solid/solid_family.hpp"

namespace dovetail::geometry {

inline constexpr double kRadian = std::numbers::pi / 180;

/// Coarse enough for many solids in a test.
inline MeshSizes coarse_section() {
  return {.flank_elements = 4,
          .fillet_fraction = 0.7,
          .bulk_size = 12e-3,
          .aerofoil_elements = 8,
          .blend_fraction = 0.8,
          .growth = 0.5};
}

/// Everything a solid can have.
inline SolidParameters everything() {
  return {.skew_angle = 20 * kRadian,
          .stagger = 25 * kRadian,
          .twist = 20 * kRadian,
          .tip_chord = 30e-3,
          .lean = 3e-3,
          .edge_thickness_fraction = 0.5,
          .axial_crown = 5e-6,
          .axial_relief_length = 4e-3,
          .axial_relief_depth = 8e-6};
}

/// Volume, m3, of one region of a mesh in space.
inline double region_volume(fem::Mesh mesh, int region) {
  for (std::size_t e = 0; e < mesh.region.size(); ++e) {
    mesh.regions[static_cast<std::size_t>(mesh.region[e])].body = mesh.region[e];
  }
  return measure_of_body(mesh, region);
}

}  // namespace dovetail::geometry
