#include "geometry/rules/solid_rules.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/profile/profile.hpp"
#include "geometry/rules/params.hpp"
#include "geometry/rules/rule_list.hpp"
#include "geometry/solid/slot_sweep.hpp"

namespace dovetail::geometry {
namespace {

using Eigen::Vector2d;
constexpr RuleParams kRule = {};

/// Least determinant over the platform's top from the blend's foot at x to the side, at the slot's end at z.
double least_stretch(const ProfileParameters& p, const SolidParameters& solid, double foot, double z) {
  const double side = p.platform_width / 2, fall = -1 / (side - foot);
  const double s = std::sin(solid.stagger), c = std::cos(solid.stagger), slot = std::tan(solid.skew_angle);
  const double chord = p.chord / p.slot_length;
  double least = kInfinity;
  for (int k = 0; k <= kRule.places; ++k) {
    const double x = foot + (side - foot) * k / kRule.places, weight = fall * (x - side);
    Eigen::Matrix2d change;
    change << 1 + weight * (c - 1) + fall * (z * (chord * s - slot) + x * (c - 1)), slot + weight * (chord * s - slot),
        fall * z * (chord * c - 1) - (weight * weight + 2 * weight * fall * x) * s, 1 + weight * (chord * c - 1);
    least = std::min(least, change.determinant());
  }
  return least;
}

void platform(RuleList& rules, const Profile& profile, const ProfileParameters& p, const SolidParameters& solid) {
  const double foot = edge(profile.blade, "platform_top_right").end.x(), width = p.platform_width / 2 - foot;
  const double off = p.chord / 2 * std::abs(std::sin(solid.stagger - solid.skew_angle)) / std::cos(solid.skew_angle);
  rules.at_least("aerofoil_on_platform", "the width of the platform beside the aerofoil's edge", width - off,
                 width / kRule.beside, "as a fifth of that in mid-chord");
  rules.share_at_least(
      "platform_follows_aerofoil",
      "the least area of a piece of the platform beside the aerofoil against that without angles",
      std::min(least_stretch(p, solid, foot, p.slot_length / 2), least_stretch(p, solid, foot, -p.slot_length / 2)),
      kRule.stretch, "for the platform not to fold");
}

/// Distances to the cuts where the skew makes them smallest. Below the rim the slot moves further than the cuts, the
/// platform above it less far.
void cuts(RuleList& rules, const Profile& profile, const ProfileParameters& p, const SolidParameters& solid) {
  const double half_pitch = std::numbers::pi / p.sectors;
  const double end = std::copysign(p.slot_length / 2, solid.skew_angle);
  for (const int side : {-1, 1}) {
    const char* name = side < 0 ? "left" : "right";
    const auto named = [name](const char* part) { return std::string(part) + "_" + name; };
    const auto to_cut = [&](const Vector2d& at, double z) {
      const Vector2d back = Eigen::Rotation2D<double>(turn_at(p, solid, z)) * at;
      return back.y() * std::sin(half_pitch) - side * back.x() * std::cos(half_pitch);
    };
    const double towards = side * end;
    const Profile near = section_at(profile, p, solid, towards), far = section_at(profile, p, solid, -towards);
    const Edge& under = edge(far.blade, named("platform_bottom"));
    const Edge& fillet = edge(near.disk, named("slot_fillet"));
    const Edge& mouth = edge(near.disk, named("mouth"));
    const std::string at_end = std::string(" to the sector's ") + name + " cut at the end of the slot";
    rules.at_least(named("platform") + "_within_cut_at_ends", "the distance of the platform" + at_end,
                   to_cut(side > 0 ? under.end : under.start, -towards), 0, "for neighbouring platforms not to touch");
    rules.at_least(named("slot") + "_within_cut_at_ends", "the distance of the slot fillet" + at_end,
                   to_cut(fillet.center, towards) - fillet.radius, 0, "for the slot to stay within its sector");
    rules.at_least(named("mouth") + "_within_cut_at_ends", "the distance of the slot's mouth" + at_end,
                   to_cut(side > 0 ? mouth.start : mouth.end, towards), 0, "for the slot to stay within its sector");
  }
}

}  // namespace

std::vector<Rule> solid_rules(const ProfileParameters& parameters, const SolidParameters& solid) {
  (void)checked(solid);
  const Profile profile = build_profile(parameters);
  RuleList rules;
  platform(rules, profile, parameters, solid);
  cuts(rules, profile, parameters, solid);
  rules.at_least("axial_relief_fits", "the length of the slot", parameters.slot_length / std::cos(solid.skew_angle),
                 2 * solid.axial_relief_length, "for the relieved zones at its ends not to meet");
  return rules.take();
}

}  // namespace dovetail::geometry
