#include "geometry/solid/slot_sweep.hpp"

#include <Eigen/Geometry>
#include <cassert>
#include <cmath>

namespace dovetail::geometry {
namespace {

using Eigen::Vector2d;

Edge shifted(Edge e, double by) {
  e.start.x() += by;
  e.end.x() += by;
  e.center.x() += by;
  return e;
}

Edge turned(Edge e, const Eigen::Rotation2D<double>& turn) {
  e.start = turn * e.start;
  e.end = turn * e.end;
  if (e.is_arc()) e.center = turn * e.center;
  return e;
}

/// The point of the rim above or below `at`.
Vector2d on_rim(double rim_radius, double x) {
  assert(std::abs(x) < rim_radius);
  return {x, std::sqrt(rim_radius * rim_radius - x * x)};
}

/// Arc about the axis between its two ends.
void fit_about_axis(Edge& e) {
  e.sweep = std::atan2(e.start.x() * e.end.y() - e.start.y() * e.end.x(), e.start.dot(e.end));
}

}  // namespace

double turn_at(const ProfileParameters& parameters, const SolidParameters& solid, double z) {
  return z * std::tan(solid.skew_angle) / parameters.rim_radius;
}

Profile section_at(const Profile& section, const ProfileParameters& parameters, const SolidParameters& solid,
                   double z) {
  const double shift = z * std::tan(solid.skew_angle);
  const Eigen::Rotation2D<double> turn(-turn_at(parameters, solid, z));
  Profile result;
  for (const Edge& e : section.blade) result.blade.push_back(shifted(e, shift));
  for (const Edge& e : section.disk) {
    const bool about_axis = e.name.starts_with("bore") || e.name.starts_with("cut") || e.name.starts_with("rim");
    result.disk.push_back(about_axis ? turned(e, turn) : shifted(e, shift));
  }
  if (shift == 0) return result;
  for (std::size_t i = 0; i < result.disk.size(); ++i) {
    Edge& e = result.disk[i];
    if (e.name == "rim_right") {
      Edge& mouth = result.disk[i + 1];
      mouth.start = e.end = on_rim(parameters.rim_radius, mouth.start.x());
      fit_about_axis(e);
    } else if (e.name == "rim_left") {
      Edge& mouth = result.disk[i - 1];
      mouth.end = e.start = on_rim(parameters.rim_radius, mouth.end.x());
      fit_about_axis(e);
    }
  }
  return result;
}

std::vector<double> layer_ends(double slot_length, int parts, double grading) {
  assert(parts > 0);
  const double b = (1 - grading) / 3;
  std::vector<double> ends;
  for (int k = 0; k <= parts; ++k) {
    const double u = static_cast<double>(2 * k - parts) / parts;
    ends.push_back(slot_length / 2 * (u - b * u * u * u) / (1 - b));
  }
  return ends;
}

FlankFrame flank_frame(const Vector2d& along_flank, bool left, double skew_angle) {
  const Eigen::Vector3d flank(along_flank.x(), along_flank.y(), 0);
  const Eigen::Vector3d slot(std::sin(skew_angle), 0, std::cos(skew_angle));
  FlankFrame frame;
  // On the right, neck to root side and +z span the outward normal backwards.
  frame.normal = (left ? flank.cross(slot) : slot.cross(flank)).normalized();
  frame.tangents.col(0) = (flank - flank.dot(slot) * slot).normalized();
  frame.tangents.col(1) = slot;
  return frame;
}

}  // namespace dovetail::geometry
