#pragma once

namespace dovetail::geometry {

/// What rules ask for besides the limits of a study.
struct RuleParams {
  double straight = 0.05e-3;  ///< shortest straight part, and least step from the lobe's radius to the neck fillet's, m
  /// Least local change of area, seen along the radius, of a platform between its side and the aerofoil (1: none).
  /// Lower: elements there fold before the rule says so.
  double stretch = 0.2;
  int places = 24;             ///< between the blend's foot and the side at which that is looked for
  double beside = 5;           ///< width of the platform in mid-chord over the least beside the aerofoil's edge
  double overlap_unit = 1e-3;  ///< depth of an overlap that counts as a margin of -1, m
};

static_assert(RuleParams{}.stretch > 0 && RuleParams{}.stretch < 1, "a platform without angles is kept");
static_assert(RuleParams{}.straight < RuleParams{}.overlap_unit, "straight parts are short of a millimetre");

}  // namespace dovetail::geometry
