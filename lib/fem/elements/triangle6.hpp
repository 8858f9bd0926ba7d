#pragma once

#include <Eigen/Core>
#include <array>

#include "fem/elements/element_kind.hpp"

namespace dovetail::fem {

/// A point of an element's quadrature rule.
template <int Dimensions>
struct QuadraturePoint {
  Eigen::Matrix<double, Dimensions, 1> local;  ///< local coordinates
  double weight = 0;
};

/// Six-node isoparametric triangle, plane strain or plane stress. Local coordinates (xi, eta): node 0 at (0,0), node 1
/// at (1,0), node 2 at (0,1); weights sum to 1/2.
///
/// One quadrature for everything: the six-point rule of degree 4 [Dunavant 1985], positive weights,
/// interior points. Exact for stiffness and mass of straight-sided elements (integrands of degree 2 and
/// 4); on curved elements exact for area, first moments and the linear patch test, and of higher order than the
/// interpolation for the rest.
struct Triangle6 {
  static constexpr ElementKind kKind = ElementKind::triangle6;
  static constexpr int kDimensions = 2, kNodes = 6, kPoints = 6;
  static constexpr int kStresses = 3;  ///< (xx, yy, xy)
  using Point = Eigen::Matrix<double, kDimensions, 1>;
  using Shape = Eigen::Matrix<double, kNodes, 1>;
  using Gradients = Eigen::Matrix<double, kNodes, kDimensions>;

  [[nodiscard]] static const std::array<QuadraturePoint<kDimensions>, kPoints>& quadrature();
  [[nodiscard]] static Point node(int index);  ///< local coordinates of a node
  [[nodiscard]] static Shape shape(const Point& local);
  [[nodiscard]] static Gradients gradients(const Point& local);  ///< d N / d (xi, eta)

  /// Triangles with straight sides through the element's nodes that fill it.
  [[nodiscard]] static const std::array<std::array<int, 3>, 4>& simplices();
  /// Nodes of the sides: start, middle, end, counter-clockwise.
  [[nodiscard]] static const std::array<std::array<int, 3>, 3>& sides();
};

}  // namespace dovetail::fem
