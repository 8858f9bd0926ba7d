#include "geometry/profile/measures.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/profile/chain.hpp"

namespace dovetail::geometry {

namespace {

using Eigen::Vector2d;

double cross(const Vector2d& a, const Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

}  // namespace

double area(const Chain& chain) {
  const Vector2d from = chain.front().start;  // as origin: coordinates of some mm lose no digits
  double sum = 0;
  for (const Edge& e : chain) {
    sum += cross(Vector2d(e.start - from), Vector2d(e.end - from)) / 2;
    if (e.is_arc()) sum += e.radius * e.radius * (e.sweep - std::sin(e.sweep)) / 2;
  }
  return sum;
}

Eigen::AlignedBox2d bounding_box(const Chain& chain) {
  Eigen::AlignedBox2d box;
  for (const Edge& e : chain) {
    box.extend(e.start);
    box.extend(e.end);
    if (!e.is_arc()) continue;
    const Vector2d start = e.start - e.center;
    for (const Vector2d& axis : {Vector2d(1, 0), Vector2d(0, 1), Vector2d(-1, 0), Vector2d(0, -1)}) {
      double turn = std::atan2(cross(start, axis), start.dot(axis));
      if (turn * e.sweep < 0) turn += std::copysign(2 * std::numbers::pi, e.sweep);
      if (std::abs(turn) <= std::abs(e.sweep)) box.extend(Vector2d(e.center + e.radius * axis));
    }
  }
  return box;
}

Chain aerofoil(const Profile& profile) {
  const auto named = [&](const char* name) {
    return std::find_if(profile.blade.begin(), profile.blade.end(), [&](const Edge& e) { return e.name == name; });
  };
  Chain part(named("aerofoil_blend_right"), std::next(named("aerofoil_blend_left")));
  part.push_back(line("aerofoil_foot", part.back().end, part.front().start));
  return part;
}

SectorMass mass(const ProfileParameters& parameters, double blade_density, double disk_density) {
  const Profile profile = build_profile(parameters);
  const double above = area(aerofoil(profile));
  const double below = area(profile.blade) - above;
  return {.blade = blade_density * (above * parameters.chord + below * parameters.slot_length),
          .disk = disk_density * area(profile.disk) * parameters.slot_length};
}

Measures measure(const Profile& profile, const ProfileParameters& parameters) {
  const double angle = std::numbers::pi / parameters.sectors;
  const auto blade = [&](const char* name) -> const Edge& { return edge(profile.blade, name); };
  const auto disk = [&](const char* name) -> const Edge& { return edge(profile.disk, name); };
  const auto to_cut = [&](const Vector2d& at) { return at.y() * std::sin(angle) - std::abs(at.x()) * std::cos(angle); };
  const auto along = [](const Edge& e, const Vector2d& direction) { return (e.end - e.start).dot(direction); };
  const auto to_cut_fillet = [&](const Edge& e, double side) {
    return e.center.y() * std::sin(angle) - side * e.center.x() * std::cos(angle) - e.radius;
  };
  const auto runout_direction = [](const FlankParameters& f, double side) {
    return Vector2d(std::sin(f.angle), -side * std::cos(f.angle));
  };

  Measures m{};
  m.neck_straight = {along(blade("neck_left"), {0, -1}), along(blade("neck_right"), {0, 1})};
  m.mouth_straight = {along(disk("mouth_left"), {0, 1}), along(disk("mouth_right"), {0, -1})};
  m.runout = {along(disk("runout_left"), runout_direction(parameters.flank("left"), -1)),
              along(disk("runout_right"), runout_direction(parameters.flank("right"), 1))};
  m.slot_to_cut = {to_cut_fillet(disk("slot_fillet_left"), -1), to_cut_fillet(disk("slot_fillet_right"), 1)};
  m.mouth_to_cut = {to_cut(disk("mouth_left").end), to_cut(disk("mouth_right").start)};
  m.post = m.slot_to_cut[0] + m.slot_to_cut[1];
  m.shoulder = along(blade("shoulder_right"), Vector2d(1, 1).normalized());
  m.shank = along(blade("shank_right"), {0, 1});
  m.platform_underside = along(blade("platform_bottom_right"), {1, 0});
  m.platform_top = along(blade("platform_top_right"), {-1, 0});
  const Edge& side = blade("aerofoil_right");
  m.aerofoil_side = side.end.y() - side.start.y();
  m.root_bottom = along(blade("root_bottom"), {1, 0});
  m.slot_floor = along(disk("slot_floor"), {-1, 0});
  m.bottom_gap = blade("root_bottom").start.y() - disk("slot_floor").start.y();
  m.web = disk("slot_floor").start.y() - parameters.bore_radius;
  m.shank_above_rim = blade("neck_right").end.y() - parameters.rim_radius;
  m.platform_to_cut = to_cut(blade("platform_bottom_right").end);
  return m;
}

}  // namespace dovetail::geometry
