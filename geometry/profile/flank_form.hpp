#pragma once

#include <array>

#include "geometry/profile/params.hpp"
#include "geometry/profile/profile.hpp"

namespace dovetail::geometry {

/// w = sqrt(2 R EdgeParams::drop): how much of the flank's length, from its end, the rounding with radius R takes; 0
/// without.
[[nodiscard]] double rounded_length(double edge_radius);

/// The micrometre form of a blade flank: how far it stays behind the nominal flank, at s = 0 (neck-side end)
/// to 1 (root-side end), measured along the normal:
///
///   g(s) = mismatch s + crown (2 s - 1)^2 + depth (relief(s) + relief(1 - s)) + edge(s) + edge(1 - s) - c,
///   relief(s) = (1 - s length / relief_length)^2 where s length < relief_length, else 0,
///   edge(s) = (w - s length)^2 / (2 edge_radius) where s length < w = rounded_length(edge_radius), else 0.
///
/// edge(s) is the parabola of a circle that leaves the flank at w from its end. The flank's ends so stay where the
/// section has them, EdgeParams::drop behind, and what is straight is the rest. feasibility.hpp keeps half of the flank
/// straight.
///
/// c makes the smallest gap over the flank zero: a rigid shift of the blade, so the form only ever takes
/// material away. mismatch > 0 opens the root side, crown > 0 lets the middle touch first, crown < 0 the ends.
class FlankForm {
 public:
  explicit FlankForm(const FlankParameters& parameters);

  /// Gap at s, m, >= 0.
  [[nodiscard]] double gap(double s) const;
  /// dg/ds there, m.
  [[nodiscard]] double slope(double s) const;
  /// Borders of the pieces on each of which g is one parabola: 0, the inner borders of reliefs and roundings in rising
  /// order, 1.
  [[nodiscard]] const std::array<double, 6>& pieces() const { return pieces_; }

 private:
  [[nodiscard]] double raw(double s) const;

  FlankParameters parameters_;
  std::array<double, 6> pieces_{};
  double shift_ = 0;
};

/// The blade as it is to be made: the edges flank_right and flank_left are replaced by short chains
/// flank_right_1, flank_right_2, ... of lines and of arcs through three points each, which follow the nominal
/// flank moved into the blade by the gap, to within FinishedParams::error. The neck fillet and root corner beside them
/// are drawn again through their far end, their middle moved by half the gap at the flank's end, and the finished
/// flank's end; so the chain stays closed, with a change of direction of about 2 gap/radius (0.01 for 10 um on
/// 2 mm) at their ends. The number of flank edges depends on the form; without any form it is one line.
[[nodiscard]] Chain finished_blade(const ProfileParameters& parameters);

/// An edge beside a flank that lost `gap` at the end they share, drawn anew as above: through its far end, its middle
/// moved into the material by gap/2, and `moved`, the flank's end.
[[nodiscard]] Edge redrawn(const Edge& edge, bool at_start, const Eigen::Vector2d& moved, double gap);

/// Unit normal of an edge of a closed chain, out of the material.
[[nodiscard]] Eigen::Vector2d outward(const Edge& edge, double fraction);

}  // namespace dovetail::geometry
