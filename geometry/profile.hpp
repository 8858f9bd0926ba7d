#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "geometry/parameters.hpp"

namespace dovetail::geometry {

/// A straight line or a true circular arc from `start` to `end`.
struct Edge {
  std::string name;             ///< "flank_right", "neck_fillet_left", ...: the same in every design
  Eigen::Vector2d start, end;   ///< m
  Eigen::Vector2d center{0, 0}; ///< arcs only
  double radius = 0;            ///< 0: straight line
  double sweep = 0;             ///< arcs only: signed angle from start to end, rad, counter-clockwise positive

  [[nodiscard]] bool is_arc() const { return radius > 0; }
  [[nodiscard]] double length() const;
  /// Point at a fraction 0..1 of the length.
  [[nodiscard]] Eigen::Vector2d point(double fraction) const;
  /// Unit tangent in the direction of travel.
  [[nodiscard]] Eigen::Vector2d tangent(double fraction) const;
};

/// A closed chain: every edge ends where the next one starts; material lies to the left (counter-clockwise).
using Chain = std::vector<Edge>;

/// The section of one sector: blade (root, shank, platform, aerofoil) and disk (slot, two half posts,
/// rim, cuts, bore), nominal, i.e. with both straight flanks coinciding exactly (the same end points).
/// The chains have the same edges in the same order in every design. The micrometre form of the flanks
/// (mismatch, crown, relief) is the gap function of flank_form.hpp.
struct Profile {
  Chain blade;
  Chain disk;
};

/// Builds the nominal section. Defined for any finite parameters for which the arcs exist; whether the
/// design is any good is judged by feasibility.hpp. Throws InputError when a dimension is not finite or
/// not positive where it must be.
[[nodiscard]] Profile build_profile(const ProfileParameters& parameters);

/// The edge of that name. Asserts that it exists.
[[nodiscard]] const Edge& edge(const Chain& chain, const std::string& name);

}  // namespace dovetail::geometry
