#include "geometry/solid/aerofoil_form.hpp"

#include <cmath>

namespace dovetail::geometry {

AerofoilForm::AerofoilForm(const Profile& profile, const ProfileParameters& parameters, const SolidParameters& solid)
    : root_chord_(parameters.chord),
      tip_chord_(tip_chord(parameters, solid)),
      stagger_(solid.stagger),
      twist_(solid.twist),
      lean_(solid.lean),
      edge_fraction_(solid.edge_thickness_fraction) {
  const Edge& side = edge(profile.blade, "aerofoil_right");
  root_ = side.start.y();
  tip_ = side.end.y();
  root_thickness_ = 2 * side.start.x();
  tip_thickness_ = 2 * side.end.x();
}

Eigen::Vector2d AerofoilForm::chord_point(double s, double eta) const {
  const double zeta = eta * (root_chord_ + s * (tip_chord_ - root_chord_)) / 2;
  return {zeta * std::sin(angle(s)) + lean_ * s * s, zeta * std::cos(angle(s))};
}

double AerofoilForm::volume() const {
  // Chord and thickness are linear in s: the integral of their product.
  const double mean_area = (2 * (root_chord_ * root_thickness_ + tip_chord_ * tip_thickness_) +
                            root_chord_ * tip_thickness_ + tip_chord_ * root_thickness_) /
                           6;
  return (tip_ - root_) * mean_area * (2 + edge_fraction_) / 3;
}

}  // namespace dovetail::geometry
