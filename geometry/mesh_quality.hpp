#pragma once

#include "fem/mesh.hpp"

namespace dovetail::geometry {

/// How good the elements of a mesh are; the worst over all elements.
struct MeshQuality {
  /// min over elements and sample points (the 7 points of the degree-5 rule and the 6 nodes) of
  /// `2/sqrt(3) det J / (a b)`, a and b the two longest corner-to-corner lengths: 1 for an
  /// equilateral triangle with straight sides, <= 0 for an inverted element.
  double minimum_scaled_jacobian = 0;
  double minimum_angle = 0;   ///< smallest angle of the straight triangles through the corners, rad
  double maximum_angle = 0;   ///< largest such angle, rad
  int inverted_elements = 0;  ///< elements with det J <= 0 at a sample point
  int worst_element = -1;     ///< where minimum_scaled_jacobian occurs
};

/// Below these a moved mesh is given up and the design is meshed afresh.
struct MeshLimits {
  double minimum_scaled_jacobian = 0.25;  ///< 0 < value < 1
  double minimum_angle = 0.21;            ///< rad, 0 < value < pi/3
};

/// Cost O(elements).
[[nodiscard]] MeshQuality assess(const fem::Mesh& mesh);

/// Whether the mesh may be used as it is.
[[nodiscard]] bool acceptable(const MeshQuality& quality, const MeshLimits& limits);

}  // namespace dovetail::geometry
