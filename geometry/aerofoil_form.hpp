#pragma once

#include <Eigen/Core>

#include "geometry/parameters.hpp"
#include "geometry/profile.hpp"
#include "geometry/solid_parameters.hpp"

namespace dovetail::geometry {

/// The aerofoil as a solid: where a point of the plane aerofoil comes to lie. With s the fraction of the span (0 at
/// the upper ends of the blends, 1 at the tip), xi the distance from the centre line in the section and eta from -1
/// (edge at lower z) to 1 along the chord,
///
///   zeta = eta c(s)/2,                       c from chord to tip_chord, linear,
///   f    = e + (1 - e)(1 - eta^2),           e = edge_thickness_fraction,
///   beta = stagger + s twist,
///   x = xi f cos(beta) + zeta sin(beta) + lean s^2,
///   z = zeta cos(beta) - xi f sin(beta),     y unchanged.
///
/// So every section y = const is turned about the radial line through x = z = 0 and its area is that of c(s) times
/// the plane thickness times (2 + e)/3.
class AerofoilForm {
 public:
  AerofoilForm(const Profile& profile, const ProfileParameters& parameters, const SolidParameters& solid);

  /// Span fraction of a point of the plane aerofoil.
  [[nodiscard]] double span_fraction(double y) const { return (y - root_) / (tip_ - root_); }
  /// (x, z) of a point, see above.
  [[nodiscard]] Eigen::Vector2d place(double s, double xi, double eta) const;
  /// Volume above the blends, m3: closed form.
  [[nodiscard]] double volume() const;

 private:
  double root_, tip_;                      // y of both ends
  double root_thickness_, tip_thickness_;  // of the section there
  double root_chord_, tip_chord_, stagger_, twist_, lean_, edge_fraction_;
};

}  // namespace dovetail::geometry
