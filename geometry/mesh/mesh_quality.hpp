#pragma once

#include "fem/mesh.hpp"

namespace dovetail::geometry {

/// How good the elements of a mesh are; the worst over all elements.
struct MeshQuality {
  /// min over elements and sample points (the points of the element's quadrature, its centre, and its nodes) of
  /// `2/sqrt(3) det J / (a b)` for triangles, a and b the two longest corner-to-corner lengths, and of
  /// `2/sqrt(3) det J / (a b h)` for wedges, a and b such lengths averaged over both ends and 2 h the mean length of
  /// the three uprights: 1 for an equilateral triangle with straight sides and the straight prism over it, however
  /// high; <= 0 for an inverted element.
  double minimum_scaled_jacobian = 0;
  double minimum_angle = 0;   ///< smallest angle of the straight triangles through the corners, rad
  double maximum_angle = 0;   ///< largest such angle, rad
  int inverted_elements = 0;  ///< elements with det J <= 0 at a sample point
};

/// Below these a moved plane mesh is given up and the design is meshed afresh.
struct MeshLimits {
  double minimum_scaled_jacobian = 0.25;  ///< 0 < value < 1
  double minimum_angle = 0.21;            ///< rad, 0 < value < pi/3
};

/// Cost O(elements).
[[nodiscard]] MeshQuality assess(const fem::Mesh& mesh);

/// Whether the mesh may be used as it is.
[[nodiscard]] bool acceptable(const MeshQuality& quality, const MeshLimits& limits);

/// Volume, m3, of one body of a mesh in space; area, m2, of one in the plane. By the elements' quadrature.
[[nodiscard]] double measure_of_body(const fem::Mesh& mesh, int body);

}  // namespace dovetail::geometry
