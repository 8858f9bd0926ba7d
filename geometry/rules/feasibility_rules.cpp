#include <fmt/format.h>

#include <cmath>

#include "geometry/profile/flank_form.hpp"
#include "geometry/profile/measures.hpp"
#include "geometry/rules/feasibility.hpp"
#include "geometry/rules/params.hpp"
#include "geometry/rules/rule_list.hpp"

namespace dovetail::geometry {

namespace {

void walls(RuleList& rules, const ProfileParameters& p, const Measures& m, double thinnest) {
  const auto wall = [&](const char* name, const char* what, double value) {
    rules.at_least(name, what, value, thinnest, "as the thinnest wall allowed", thinnest);
  };
  wall("neck_wall", "the width of the blade's neck", p.neck_width);
  wall("post_wall", "the narrowest width of the disk's post between two slots", m.post);
  wall("lobe_wall", "the depth of the disk's lobe between rim and flank", p.lobe_depth);
  wall("platform_wall", "the thickness of the platform", p.platform_thickness);
  wall("aerofoil_root_wall", "the thickness of the aerofoil at its root", p.aerofoil_root_thickness);
  wall("aerofoil_tip_wall", "the thickness of the aerofoil at its tip", p.aerofoil_tip_thickness);
  wall("web_wall", "the height of the disk between slot floor and bore", m.web);
}

void fits(RuleList& rules, const Measures& m) {
  rules.straight("neck_left", "the neck's left side", m.neck_straight[0]);
  rules.straight("neck_right", "the neck's right side", m.neck_straight[1]);
  rules.straight("shoulder", "the shoulder between neck and shank", m.shoulder);
  rules.straight("shank", "the shank", m.shank);
  rules.straight("platform_underside", "the platform's underside", m.platform_underside);
  rules.straight("platform_top", "the platform's top", m.platform_top);
  rules.straight("aerofoil", "the aerofoil", m.aerofoil_side);
  rules.straight("root_bottom", "the root bottom", m.root_bottom);
  rules.straight("slot_floor", "the slot floor", m.slot_floor);
  rules.straight("mouth_left", "the slot mouth's left side", m.mouth_straight[0]);
  rules.straight("mouth_right", "the slot mouth's right side", m.mouth_straight[1]);
  rules.straight("runout_left", "the slot's left side below the blade's flank", m.runout[0]);
  rules.straight("runout_right", "the slot's right side below the blade's flank", m.runout[1]);
}

void clearances(RuleList& rules, const Measures& m) {
  const auto clear = [&](const char* name, const char* what, double value, const char* why) {
    rules.at_least(name, what, value, 0, why);
  };
  clear("bottom_gap", "the distance between root bottom and slot floor", m.bottom_gap, "for them not to touch");
  clear("shank_above_rim", "the height of the shank's shoulder above the rim", m.shank_above_rim,
        "for the shank to pass over the rim");
  clear("platform_within_pitch", "the distance of the platform's lower edge to the sector's cut", m.platform_to_cut,
        "for neighbouring platforms not to touch");
  const char* inside = "for the slot to stay within its sector";
  clear("slot_left_within_cut", "the distance of the left slot fillet to the sector's cut", m.slot_to_cut[0], inside);
  clear("slot_right_within_cut", "the distance of the right slot fillet to the sector's cut", m.slot_to_cut[1], inside);
  clear("mouth_left_within_cut", "the distance of the mouth's left edge to the sector's cut", m.mouth_to_cut[0],
        inside);
  clear("mouth_right_within_cut", "the distance of the mouth's right edge to the sector's cut", m.mouth_to_cut[1],
        inside);
}

void radii(RuleList& rules, const ProfileParameters& p, double cutter) {
  rules.at_least("lobe_within_neck_fillet", "the neck fillet's radius", p.neck_fillet_radius,
                 p.lobe_radius + RuleParams{}.straight, "for the lobe to stay clear of it");
  rules.at_least("root_corner_within_slot_fillet", "the slot fillet's radius", p.slot_fillet_radius,
                 p.root_corner_radius, "for the root corner to stay clear of it");
  const char* cut = "for the tool to cut it";
  rules.at_least("neck_fillet_cutter", "the neck fillet's radius", p.neck_fillet_radius, cutter, cut);
  rules.at_least("slot_fillet_cutter", "the slot fillet's radius", p.slot_fillet_radius, cutter, cut);
  rules.at_least("blend_cutter", "the blend radius", p.blend_radius, cutter, cut);
}

void flank(RuleList& rules, const FlankParameters& f, const std::string& side, double friction) {
  rules.at_least("relief_" + side + "_fits", "the length of the " + side + " flank", f.length, 2 * f.relief_length,
                 "for the relieved zones not to meet");
  rules.at_least("edge_" + side + "_fits", "the length of the " + side + " flank", f.length,
                 4 * rounded_length(f.edge_radius), "for half of it to stay straight between its rounded ends");
  rules.angle_at_least("self_locking_" + side, "the angle of the " + side + " flank", f.angle, std::atan(friction),
                       fmt::format("for the joint to release with a friction of {:.3g}", friction));
}

}  // namespace

std::vector<Rule> closed_form_rules(const ProfileParameters& parameters, const FeasibilityLimits& limits) {
  std::vector<Violation> found = violations(limits, "limits");
  if (!(limits.friction >= 0) || !std::isfinite(limits.friction))
    found.push_back(
        {.file = {}, .key = "limits.friction", .value = shortest(limits.friction), .allowed = "must be >= 0"});
  if (!found.empty()) throw InputError(std::move(found));

  const Measures m = measure(build_profile(parameters), parameters);
  RuleList rules;
  walls(rules, parameters, m, limits.minimum_wall);
  fits(rules, m);
  clearances(rules, m);
  radii(rules, parameters, limits.minimum_cutter_radius);
  for (std::size_t f = 0; f < kFlanks.size(); ++f)
    flank(rules, parameters.flanks[f], std::string(kFlanks[f].name), limits.friction);
  return rules.take();
}

}  // namespace dovetail::geometry
