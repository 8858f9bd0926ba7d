#include "geometry/profile/profile.hpp"

#include <cmath>
#include <numbers>
#include <utility>

#include "geometry/profile/chain.hpp"

namespace dovetail::geometry {

namespace {

using Eigen::Vector2d;
constexpr double kPi = std::numbers::pi;

/// Where the two sides meet: levels (y) that are the same left and right.
struct Levels {
  double root_bottom, slot_floor, neck_top;
};

/// Height of a flank's neck-side end above the root bottom.
double flank_rise(const ProfileParameters& p, const FlankParameters& f) {
  return p.root_corner_radius * (1 + std::sin(f.angle)) + f.length * std::cos(f.angle);
}

Levels levels(const ProfileParameters& p) {
  const double mean_sine = p.mean([](const FlankParameters& f) { return std::sin(f.angle); });
  const double flank_top = p.rim_radius - p.lobe_depth;
  const double bottom = flank_top - p.mean([&](const FlankParameters& f) { return flank_rise(p, f); });
  return {.root_bottom = bottom,
          .slot_floor = bottom - p.bottom_clearance - (p.slot_fillet_radius - p.root_corner_radius) * (1 + mean_sine),
          .neck_top = flank_top + p.neck_fillet_radius * mean_sine + p.neck_height};
}

struct FlankEnds {
  Vector2d neck, root, direction, normal;
};

FlankEnds flank_ends(const ProfileParameters& p, const FlankParameters& f, const Levels& level) {
  const double sine = std::sin(f.angle);
  const double cosine = std::cos(f.angle);
  const Vector2d neck(p.neck_width / 2 + p.neck_fillet_radius * (1 - cosine), level.root_bottom + flank_rise(p, f));
  const Vector2d direction(sine, -cosine);
  return {.neck = neck, .root = neck + f.length * direction, .direction = direction, .normal = {cosine, sine}};
}

/// Blade from the root bottom to the tip, on the right side.
Chain blade_side(const ProfileParameters& p, const FlankParameters& f, const Levels& level) {
  const FlankEnds flank = flank_ends(p, f, level);
  ChainBuilder side({flank.root.x() - p.root_corner_radius * flank.normal.x(), level.root_bottom});
  side.arc_to("root_corner", flank.root, flank.root - p.root_corner_radius * flank.normal, kPi / 2 + f.angle);
  side.line_to("flank", flank.neck);

  const Vector2d fillet_center = flank.neck + p.neck_fillet_radius * flank.normal;
  side.arc_to("neck_fillet", {p.neck_width / 2, fillet_center.y()}, fillet_center, -f.angle);
  const Vector2d neck_top(p.neck_width / 2, level.neck_top);
  side.line_to("neck", neck_top);

  const double r = p.blend_radius;
  const double sine = std::numbers::sqrt2 / 2;
  const Vector2d shoulder_start = neck_top + r * Vector2d(1 - sine, sine);
  side.arc_to("neck_blend", shoulder_start, neck_top + Vector2d(r, 0), -kPi / 4);
  const double shank_x = p.shank_width / 2;
  side.line_to("shoulder", {shank_x, shoulder_start.y() + shank_x - shoulder_start.x()});

  const double underside = level.neck_top + p.shank_height;
  side.line_to("shank", {shank_x, underside - r});
  side.arc_to("platform_blend", {shank_x + r, underside}, Vector2d(shank_x + r, underside - r), -kPi / 2);
  const double top = underside + p.platform_thickness;
  side.line_to("platform_bottom", {p.platform_width / 2, underside});
  side.line_to("platform_side", {p.platform_width / 2, top});

  const Vector2d foot(p.aerofoil_root_thickness / 2, top);
  const Vector2d tip(p.aerofoil_tip_thickness / 2, top + p.aerofoil_span);
  const Vector2d up = (tip - foot).normalized();
  const double turn = std::atan2(up.y(), up.x());  // from the platform's outward direction to the aerofoil's side
  const double reach = r / std::tan(turn / 2);
  side.line_to("platform_top", foot + Vector2d(reach, 0));
  side.arc_to("aerofoil_blend", foot + reach * up, foot + Vector2d(reach, r), turn - kPi);
  side.line_to("aerofoil", tip);
  return side.chain();
}

/// Disk from the bore to the slot floor, on the right side.
Chain disk_side(const ProfileParameters& p, const FlankParameters& f, const Levels& level) {
  const FlankEnds flank = flank_ends(p, f, level);
  const Vector2d cut(std::sin(kPi / p.sectors), std::cos(kPi / p.sectors));
  ChainBuilder side(p.bore_radius * cut);
  side.line_to("cut", p.rim_radius * cut);

  const Vector2d lobe_center = flank.neck + p.lobe_radius * flank.normal;
  const double mouth_x = lobe_center.x() - p.lobe_radius;
  const Vector2d mouth(mouth_x, std::sqrt(p.rim_radius * p.rim_radius - mouth_x * mouth_x));
  side.arc_to("rim", mouth, Vector2d(0, 0), kPi / p.sectors - std::asin(mouth_x / p.rim_radius));
  side.line_to("mouth", {mouth_x, lobe_center.y()});
  side.arc_to("lobe", flank.neck, lobe_center, f.angle);
  side.line_to("flank", flank.root);

  const double radius = p.slot_fillet_radius;
  const double runout = (flank.root.y() - level.slot_floor - radius * (1 + flank.normal.y())) / flank.normal.x();
  const Vector2d runout_end = flank.root + runout * flank.direction;
  side.line_to("runout", runout_end);
  const Vector2d fillet_center = runout_end - radius * flank.normal;
  side.arc_to("slot_fillet", {fillet_center.x(), level.slot_floor}, fillet_center, -(kPi / 2 + f.angle));
  return side.chain();
}

/// `first` (from the left to the right side), right side, an optional straight `last`, left side.
Chain closed(Edge first, Chain right, Chain left, const char* last) {
  for (Edge& e : right) e.name += "_right";
  for (Edge& e : left) e.name += "_left";
  left = mirrored(left);
  Chain chain{std::move(first)};
  chain.insert(chain.end(), right.begin(), right.end());
  chain.push_back(line(last, right.back().end, left.front().start));
  chain.insert(chain.end(), left.begin(), left.end());
  return chain;
}

Vector2d mirrored(const Vector2d& at) {
  return {-at.x(), at.y()};
}

void check(const ProfileParameters& p) {
  std::vector<Violation> found = violations(p, "geometry");
  for (std::size_t f = 0; f < kFlanks.size(); ++f)
    for (Violation& violation : violations(p.flanks[f], "geometry." + std::string(kFlanks[f].name)))
      found.push_back(violation);
  if (!found.empty()) throw InputError(std::move(found));
  for (const FlankParameters& f : p.flanks) {
    const double mouth = p.neck_width / 2 + (p.neck_fillet_radius - p.lobe_radius) * (1 - std::cos(f.angle));
    if (std::abs(mouth) >= p.rim_radius)
      throw InputError({.file = {},
                        .key = "geometry.rim_radius_mm",
                        .value = shortest(p.rim_radius * 1e3),
                        .allowed = "must exceed half the width of the slot's mouth, " + shortest(mouth * 1e3) + " mm"});
  }
}

}  // namespace

Profile build_profile(const ProfileParameters& parameters) {
  check(parameters);
  const Levels level = levels(parameters);
  Profile profile;

  Chain right = blade_side(parameters, parameters.flank("right"), level);
  Chain left = blade_side(parameters, parameters.flank("left"), level);
  Edge first = line("root_bottom", mirrored(left.front().start), right.front().start);
  profile.blade = closed(std::move(first), std::move(right), std::move(left), "tip");

  right = disk_side(parameters, parameters.flank("right"), level);
  left = disk_side(parameters, parameters.flank("left"), level);
  first = arc("bore", mirrored(left.front().start), right.front().start, Vector2d(0, 0), -2 * kPi / parameters.sectors);
  profile.disk = closed(std::move(first), std::move(right), std::move(left), "slot_floor");
  return profile;
}

}  // namespace dovetail::geometry
