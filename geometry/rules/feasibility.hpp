#pragma once

#include <string>
#include <vector>

#include "geometry/profile/profile.hpp"
#include "geometry/solid/solid_parameters.hpp"

namespace dovetail::geometry {

/// One thing a design has to keep.
struct Rule {
  std::string name;      ///< "neck_wall", "root_bottom_fits", ...: the same rules in the same order for every design
  double margin = 0;     ///< kept when >= 0
  std::string sentence;  ///< what is measured, what is required and the difference, in mm or degrees
};

struct Feasibility {
  bool feasible = false;    ///< every margin >= 0
  std::vector<Rule> rules;  ///< all of them, kept or not
  double overlap_area =
      0;  ///< of blade and disk, m2; 0 when a chain crosses itself or is inside out (not defined then)
};

/// The rules that follow from closed forms of the dimensions. Margins are smooth in all parameters:
///
/// - walls, (thickness - minimum_wall)/minimum_wall: neck_wall, post_wall, lobe_wall (rim to flank), platform_wall,
///   aerofoil_root_wall, aerofoil_tip_wall, web_wall (slot floor to bore: also violated by a slot that is deeper
///   than the disk is high);
/// - straight parts between blends, (length - RuleParams::straight)/1 mm: neck_left_fits, neck_right_fits,
///   shoulder_fits (includes: shank wider than neck), shank_fits, platform_underside_fits, platform_top_fits,
///   aerofoil_fits, root_bottom_fits, slot_floor_fits, mouth_left_fits, mouth_right_fits, runout_left_fits,
///   runout_right_fits;
/// - clearances, distance/1 mm: bottom_gap, shank_above_rim, platform_within_pitch, slot_left_within_cut,
///   slot_right_within_cut, mouth_left_within_cut, mouth_right_within_cut;
/// - radii against each other: lobe_within_neck_fillet (the neck fillet is larger by RuleParams::straight),
///   root_corner_within_slot_fillet (the slot fillet is not smaller), /1 mm;
/// - re-entrant radii against the tool, (radius - minimum_cutter_radius)/1 mm: neck_fillet_cutter,
///   slot_fillet_cutter, blend_cutter. Outer corners can be cut by any tool;
/// - relief_left_fits, relief_right_fits: the two relieved zones do not meet, /1 mm;
/// - self_locking_left, self_locking_right, (a - atan(friction))/45 degrees. When the pull ceases, the elastic
///   normal forces N of the flanks push the blade inward by N sin a each, friction holds it by at most
///   friction N cos a: it releases when tan a > friction and stays wedged otherwise. (With unequal flanks the wedge
///   holds when their angles' mean is below atan(friction): one rule per flank is on the safe side.)
[[nodiscard]] std::vector<Rule> closed_form_rules(const ProfileParameters& parameters, const FeasibilityLimits& limits);

/// All rules: the closed forms and, last, the exact checks of the chains (exact_section.hpp), which arbitrate:
///
/// - blade_simple, disk_simple: no chain crosses itself or runs clockwise. Margin 0 when kept; otherwise minus the
///   sum of squares of the broken margins among the chain's straight parts (-1 when none is broken).
/// - no_overlap: blade and disk have nothing but their flanks in common. Margin 0 when kept; otherwise minus the
///   mean depth of penetration, overlap area/(length of both flanks), /1 mm: continuous, and smooth while they
///   overlap. When a chain crosses itself the overlap is not defined and the margin is that chain's.
///
/// These three are flat where they are kept: an optimiser is led by the closed forms. Throws InputError when a
/// parameter or limit is out of range. Cost: some milliseconds.
[[nodiscard]] Feasibility check_feasibility(const ProfileParameters& parameters, const FeasibilityLimits& limits = {});

/// The same with the rules of the solid sector (solid_rules.hpp) last.
[[nodiscard]] Feasibility check_feasibility(const ProfileParameters& parameters, const SolidParameters& solid,
                                            const FeasibilityLimits& limits = {});

}  // namespace dovetail::geometry
