#pragma once

#include <vector>

#include "geometry/rules/feasibility.hpp"
#include "geometry/solid/solid_parameters.hpp"

namespace dovetail::geometry {

/// What a solid sector has to keep besides the rules of its section. a is the skew.
///
/// - aerofoil_on_platform, in mm: the aerofoil's edge is chord/2 |sin(stagger - a)|/cos(a) off the middle of the
///   platform; the width left between the blend's foot and the platform's side is at least a fifth of that in
///   mid-chord;
/// - platform_follows_aerofoil: the least determinant of d(x', z')/d(x, z), see SolidFamily, over the platform's top at
///   both ends of the slot is at least RuleParams::stretch. Broken by chords that are turned far from the slot or
///   much shorter than it, whose platform would have to fold;
/// - platform_, slot_ and mouth_, left and right, _within_cut_at_ends: the distances to the sector's cuts, which a
///   skewed slot reduces towards one end, >= 0 at the end concerned, in mm;
/// - axial_relief_fits, in mm: slot_length/cos(a) >= 2 axial_relief_length.
///
/// Margins are continuous; not smooth at zero skew, at stagger = a and where the place of the least determinant jumps.
/// Throws InputError when a parameter is out of range.
[[nodiscard]] std::vector<Rule> solid_rules(const ProfileParameters& parameters, const SolidParameters& solid);

}  // namespace dovetail::geometry
