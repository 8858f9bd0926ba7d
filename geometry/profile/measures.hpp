#pragma once

#include <Eigen/Geometry>
#include <array>

#include "geometry/profile/profile.hpp"

namespace dovetail::geometry {

/// Area enclosed by a closed chain, m2: exact for lines and arcs (Green's theorem), positive counter-clockwise.
[[nodiscard]] double area(const Chain& chain);

/// Smallest box around the chain, arcs included, m.
[[nodiscard]] Eigen::AlignedBox2d bounding_box(const Chain& chain);

/// The aerofoil alone: the part of the blade above the platform's top, blends included, closed by the straight
/// line between the blends' feet. It extends over `chord` out of the plane, everything below over `slot_length`.
[[nodiscard]] Chain aerofoil(const Profile& profile);

/// Masses of one sector, kg.
struct SectorMass {
  double blade = 0, disk = 0;
};

/// Mass of one blade and one sector of the disk, with the thicknesses of `parameters`; densities in kg/m3.
[[nodiscard]] SectorMass mass(const ProfileParameters& parameters, double blade_density, double disk_density);

/// Lengths of the section that decide about walls and fits, m, each smooth in the parameters. A negative value
/// says by how much the part does not fit. Pairs are {left, right}.
struct Measures {
  std::array<double, 2> neck_straight;   ///< straight sides of the neck
  std::array<double, 2> mouth_straight;  ///< straight sides of the slot mouth
  std::array<double, 2> runout;          ///< straight sides of the slot beyond the blade's flank
  std::array<double, 2> slot_to_cut;     ///< slot fillet to the radial cut: half of a post
  std::array<double, 2> mouth_to_cut;    ///< edge of the slot mouth to the radial cut
  double post;                           ///< narrowest width of the disk's post between two slots
  double shoulder, shank, platform_underside, platform_top, aerofoil_side;  ///< straight parts of the upper blade
  double root_bottom, slot_floor;  ///< straight parts of root bottom and slot floor
  double bottom_gap;               ///< between root bottom and slot floor
  double web;                      ///< from the slot floor down to the bore
  double shank_above_rim;          ///< from the rim's crown to the shoulder of the shank
  double platform_to_cut;          ///< lower platform edge to the radial cut: half the gap between platforms
};

/// Measures a section built by build_profile from the same parameters. Widths are signed along the edge's regular
/// direction; distances to a cut are perpendicular to it. The slot fillet's distance to the cut is that of its
/// circle, which is reached on the arc itself whatever the angles.
[[nodiscard]] Measures measure(const Profile& profile, const ProfileParameters& parameters);

}  // namespace dovetail::geometry
