#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "geometry/profile/parameters.hpp"

namespace dovetail::geometry {

/// A straight line or a true circular arc from `start` to `end`.
struct Edge {
  std::string name;              ///< "flank_right", "neck_fillet_left", ...: the same in every design
  Eigen::Vector2d start, end;    ///< m
  Eigen::Vector2d center{0, 0};  ///< arcs only
  double radius = 0;             ///< 0: straight line
  double sweep = 0;              ///< arcs only: signed angle from start to end, rad, counter-clockwise positive

  [[nodiscard]] bool is_arc() const { return radius > 0; }
  [[nodiscard]] double length() const;
  /// Point at a fraction 0..1 of the length; exactly `start` at 0 and `end` at 1.
  [[nodiscard]] Eigen::Vector2d point(double fraction) const;
  /// Unit tangent in the direction of travel.
  [[nodiscard]] Eigen::Vector2d tangent(double fraction) const;
};

/// A closed chain: every edge ends where the next one starts; material lies to the left (counter-clockwise).
using Chain = std::vector<Edge>;

/// The section of one sector: blade (root, shank, platform, aerofoil) and disk (slot, two half posts,
/// rim, cuts, bore), nominal, i.e. with both straight flanks coinciding exactly (the same end points).
/// The chains have the same edges in the same order in every design. The micrometre form of the flanks
/// (mismatch, crown, relief) is the gap function of flank_form.hpp.
///
/// Blade, in order (28 edges; `*` an arc, all transitions tangent except those marked `/`):
///
///   root_bottom, root_corner_right*, flank_right, neck_fillet_right*, neck_right, neck_blend_right*,
///   shoulder_right, / shank_right, platform_blend_right*, platform_bottom_right, / platform_side_right,
///   / platform_top_right, aerofoil_blend_right*, aerofoil_right, / tip,
///   / aerofoil_left, aerofoil_blend_left*, platform_top_left, / platform_side_left, / platform_bottom_left,
///   platform_blend_left*, shank_left, / shoulder_left, neck_blend_left*, neck_left, neck_fillet_left*,
///   flank_left, root_corner_left*
///
/// Disk, in order (16 edges):
///
///   bore*, / cut_right, / rim_right*, / mouth_right, lobe_right*, flank_right, runout_right,
///   slot_fillet_right*, slot_floor, slot_fillet_left*, runout_left, flank_left, lobe_left*, mouth_left,
///   / rim_left*, / cut_left /
///
/// So flank_right goes from its root-side to its neck-side end on the blade, the other way on the disk.
struct Profile {
  Chain blade;
  Chain disk;
};

/// Builds the nominal section.
///
/// On the right side the flank has the direction t = (sin a, -cos a), a its angle, from its neck-side end
/// F0 to its root-side end F1 = F0 + length t, and the blade's outward normal n = (cos a, sin a): the
/// centrifugal pull presses the blade on the disk. The left side is its mirror image with the left flank's
/// angle and length. Circles: neck fillet and lobe are centred on F0 + radius n, root corner on F1 - radius n,
/// slot fillet on the run-out's end - radius n.
///
/// - Where the flanks sit: the mean level of F0 on the two sides is rim_radius - lobe_depth.
/// - The root bottom is horizontal and tangent to both root corners. When the flanks differ, their F0 are at
///   different levels; the straight necks take that up (neck_height is their mean length). This keeps the
///   same edges and is smooth in all parameters, through the symmetric design too.
/// - `runout` continues the disk's flank straight past F1 before the slot fillet starts, over a radial extent
///   bottom_clearance. The slot floor so lies bottom_clearance + (slot_fillet_radius - root_corner_radius)
///   (1 + mean sin a) below the root bottom: at least bottom_clearance when the fillet is not the smaller.
/// - The shoulder between neck and shank rises at 45 degrees, so that a blend fits although the shank is only
///   little wider. The platform's underside is shank_height above the upper end of the straight neck.
/// - The radial cuts lie at +-pi/sectors from the y axis.
///
/// Defined for all parameters within the ranges of their option tables, provided that the slot is narrower
/// than the rim's diameter; straight parts that do not fit then point backwards, which feasibility.hpp
/// judges. Throws InputError otherwise.
[[nodiscard]] Profile build_profile(const ProfileParameters& parameters);

/// The edge of that name. Asserts that it exists.
[[nodiscard]] const Edge& edge(const Chain& chain, const std::string& name);

}  // namespace dovetail::geometry
