#pragma once

#include <cmath>

#include "geometry/cad/occ_shapes.hpp"
#include "geometry/cad/sector_solids.hpp"

namespace dovetail::geometry::occ {

/// See SectorSolids.
[[nodiscard]] TopoDS_Shape blade_shape(const SolidDesign& design, const Profile& profile);
[[nodiscard]] TopoDS_Shape disk_shape(const SolidDesign& design, const Profile& profile);

/// The way of the slot while z grows by one.
[[nodiscard]] inline Eigen::Vector3d slot_direction(const SolidParameters& solid) {
  return {std::tan(solid.skew_angle), 0, 1};
}

}  // namespace dovetail::geometry::occ
