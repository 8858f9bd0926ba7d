#pragma once

#include <Eigen/Core>
#include <vector>

#include "geometry/profile/parameters.hpp"
#include "geometry/profile/profile.hpp"
#include "geometry/solid/solid_parameters.hpp"

namespace dovetail::geometry {

/// The section at height z: the blade shifted along x by `z tan(skew)`, and with it the slot (mouth to slot floor) of
/// the disk; cuts, rim and bore turned about the axis by the angle `z tan(skew)/rim_radius` towards the same side, so
/// that the right cut stays the left one turned by -2 pi/sectors. The mouth's upper ends stay on the rim's circle.
/// Edges and their order are those of the section itself, which it is for z = 0. Defined while the slot lies within
/// the rim's diameter. Smooth in z.
[[nodiscard]] Profile section_at(const Profile& section, const ProfileParameters& parameters,
                                 const SolidParameters& solid, double z);

/// The angle by which cuts, rim and bore are turned at height z (clockwise, i.e. from y towards +x), rad.
[[nodiscard]] double turn_at(const ProfileParameters& parameters, const SolidParameters& solid, double z);

/// Heights of the layers' ends, m: `z(u) = slot_length/2 (u - b u^3)/(1 - b)`, u equally spaced from -1 to 1 in
/// `parts` parts, b = (1 - grading)/3, so that dz/du at the ends is `grading` times that in the middle.
[[nodiscard]] std::vector<double> layer_ends(double slot_length, int parts, double grading);

/// Directions of the bearing flank that the sweep of the section's flank along the slot makes: a plane.
struct FlankFrame {
  Eigen::Vector3d normal;                ///< unit, out of the blade into the disk
  Eigen::Matrix<double, 3, 2> tangents;  ///< T1 from neck to root side, across the slot; T2 along the slot to +z
};
/// From the unit direction of the section's flank (neck to root side) and the slot's skew; `left`: which flank.
[[nodiscard]] FlankFrame flank_frame(const Eigen::Vector2d& along_flank, bool left, double skew_angle);

}  // namespace dovetail::geometry
