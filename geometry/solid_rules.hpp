#pragma once

#include <vector>

#include "geometry/feasibility.hpp"
#include "geometry/solid_parameters.hpp"

namespace dovetail::geometry {

/// Least width of the platform beside the aerofoil's edge over that in mid-chord, as far as the mesh can follow.
inline constexpr double kLeastPlatformShare = 0.2;

/// What a solid sector has to keep besides the rules of its section. With b = platform_width/2 minus the blend's foot
/// (the platform's free width beside the aerofoil), a the skew and e = chord/2 |sin(stagger - a)|/cos(a) (how far the
/// aerofoil's edge is off the middle of the platform):
///
/// - aerofoil_on_platform: b - e >= kLeastPlatformShare b;
/// - aerofoil_reaches_slot_ends: chord cos(stagger) >= slot_length (kLeastPlatformShare + e' / b), where
///   e' = |chord sin(stagger) - slot_length tan(a)|/2 is that distance at the slot's ends' nodes: otherwise the end
///   faces of the platform, which follow the aerofoil's edges, would cross the aerofoil;
/// - platform_, slot_ and mouth_, left and right, _within_cut_at_ends: the distances to the sector's cuts, which a
///   skewed slot reduces towards one end, >= 0 at the end concerned;
/// - axial_relief_fits: slot_length/cos(a) >= 2 axial_relief_length.
///
/// Margins are in mm, smooth but for zero skew and stagger = a. Throws InputError when a parameter is out of range.
[[nodiscard]] std::vector<Rule> solid_rules(const ProfileParameters& parameters, const SolidParameters& solid);

}  // namespace dovetail::geometry
