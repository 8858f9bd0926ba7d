#pragma once

#include <Eigen/Core>
#include <array>

#include "fem/elements/triangle6.hpp"

namespace dovetail::fem {

/// Eighteen-node isoparametric wedge: Triangle6 times the three-node line, zeta in [-1, 1] (node order: ElementKind).
/// Full biquadratic nine-node faces along the sides. Quadrature: the triangle's rule times three Gauss points, exact
/// for stiffness and mass of straight prisms; weights sum to 1.
struct Wedge18 {
  static constexpr ElementKind kKind = ElementKind::wedge18;
  static constexpr int kDimensions = 3, kNodes = 18, kPoints = 18;
  static constexpr int kStresses = 6;  ///< (xx, yy, zz, xy, yz, zx)
  using Point = Eigen::Matrix<double, kDimensions, 1>;
  using Shape = Eigen::Matrix<double, kNodes, 1>;
  using Gradients = Eigen::Matrix<double, kNodes, kDimensions>;

  [[nodiscard]] static const std::array<QuadraturePoint<kDimensions>, kPoints>& quadrature();
  [[nodiscard]] static Point node(int index);
  [[nodiscard]] static Shape shape(const Point& local);
  [[nodiscard]] static Gradients gradients(const Point& local);  ///< d N / d (xi, eta, zeta)

  /// Tetrahedra with plane faces through the element's nodes that fill it: the four triangles of Triangle6 in two
  /// layers, three tetrahedra each.
  [[nodiscard]] static const std::array<std::array<int, 4>, 24>& simplices();
  /// Nodes of the nine-node sides: row by row (lower, middle, upper layer) the start, middle and end of a side of
  /// Triangle6.
  [[nodiscard]] static const std::array<std::array<int, 9>, 3>& sides();
};

}  // namespace dovetail::fem
