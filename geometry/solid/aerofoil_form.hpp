#pragma once

#include <Eigen/Core>
#include <cmath>

#include "geometry/profile/parameters.hpp"
#include "geometry/profile/profile.hpp"
#include "geometry/solid/solid_parameters.hpp"

namespace dovetail::geometry {

/// The aerofoil as a solid. A point of the plane aerofoil at the fraction s of the span (0 at the upper ends of the
/// blends, 1 at the tip) and the distance xi from the centre line comes to lie, eta from -1 (edge at lower z) to 1
/// along the chord, at
///
///   x = xi f cos(beta) + zeta sin(beta) + lean s^2,
///   z = zeta cos(beta) - xi f sin(beta),     y unchanged,
///   zeta = eta c(s)/2,                       c from chord to tip_chord, linear,
///   f    = e + (1 - e)(1 - eta^2),           e = edge_thickness_fraction,
///   beta = stagger + s twist.
///
/// So every section y = const is turned about the radial line through x = z = 0 and its area is that of c(s) times
/// the plane thickness times (2 + e)/3.
class AerofoilForm {
 public:
  AerofoilForm(const Profile& profile, const ProfileParameters& parameters, const SolidParameters& solid);

  /// Span fraction of a point of the plane aerofoil.
  [[nodiscard]] double span_fraction(double y) const { return (y - root_) / (tip_ - root_); }
  /// (x, z) of the chord's point at s and eta, xi = 0.
  [[nodiscard]] Eigen::Vector2d chord_point(double s, double eta) const;
  /// (x, z) of the unit vector across the chord.
  [[nodiscard]] Eigen::Vector2d across(double s) const { return {std::cos(angle(s)), -std::sin(angle(s))}; }
  /// f.
  [[nodiscard]] double fullness(double eta) const { return edge_fraction_ + (1 - edge_fraction_) * (1 - eta * eta); }
  /// Half the plane aerofoil's thickness at s = 0, m.
  [[nodiscard]] double half_root_thickness() const { return root_thickness_ / 2; }
  /// Volume above the blends, m3: closed form.
  [[nodiscard]] double volume() const;

 private:
  [[nodiscard]] double angle(double s) const { return stagger_ + s * twist_; }

  double root_ = 0, tip_ = 0;                      // y of both ends
  double root_thickness_ = 0, tip_thickness_ = 0;  // of the section there
  double root_chord_, tip_chord_, stagger_, twist_, lean_, edge_fraction_;
};

}  // namespace dovetail::geometry
