#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace dovetail::geometry {

/// A point of a surface and its derivatives by a, b and both.
struct SurfaceJet {
  Eigen::Vector3d at, by_a, by_b, by_ab;
};

/// Poles of the B-spline surface of degree 3 in both directions, knots twofold inside and fourfold at the ends, that
/// takes these values at its knots: one bicubic between them, with continuous slopes. A surface that is such a bicubic
/// is met to rounding. The first row of poles are those of the curve along b at the first a, and so on.
struct SplineNet {
  std::vector<double> a, b;                         ///< knots, rising
  std::vector<std::vector<Eigen::Vector3d>> poles;  ///< [2 knots of a][2 knots of b]
};
[[nodiscard]] SplineNet spline_net(std::vector<double> a, std::vector<double> b,
                                   const std::function<SurfaceJet(double a, double b)>& surface);

/// `parts` equal parts from `from` to `to`.
[[nodiscard]] std::vector<double> equal_knots(double from, double to, int parts);

/// In how many parts cubics through values and slopes follow a circular arc of this angle to within 1e-9 of its radius.
[[nodiscard]] int parts_of_turn(double angle);

}  // namespace dovetail::geometry
