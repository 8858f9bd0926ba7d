#include "fem/elements/wedge18.hpp"

#include <cmath>
#include <cstddef>

namespace dovetail::fem {

namespace {

constexpr int kLayer = Triangle6::kNodes;

/// Lagrange polynomials of the nodes -1, 0, 1 and their derivatives.
Eigen::Vector3d line(double zeta) {
  return {zeta * (zeta - 1) / 2, 1 - zeta * zeta, zeta * (zeta + 1) / 2};
}
Eigen::Vector3d line_derivative(double zeta) {
  return {zeta - 0.5, -2 * zeta, zeta + 0.5};
}

}  // namespace

const std::array<QuadraturePoint<3>, Wedge18::kPoints>& Wedge18::quadrature() {
  static const std::array<QuadraturePoint<3>, kPoints> points = [] {
    const std::array<double, 3> zeta{-std::sqrt(0.6), 0, std::sqrt(0.6)}, weight{5.0 / 9, 8.0 / 9, 5.0 / 9};
    std::array<QuadraturePoint<3>, kPoints> result;
    std::size_t q = 0;
    for (std::size_t layer = 0; layer < 3; ++layer)
      for (const QuadraturePoint<2>& point : Triangle6::quadrature())
        result[q++] = {{point.local[0], point.local[1], zeta[layer]}, point.weight * weight[layer]};
    return result;
  }();
  return points;
}

Wedge18::Point Wedge18::node(int index) {
  const Triangle6::Point plane = Triangle6::node(index % kLayer);
  const int layer = index / kLayer;
  return {plane[0], plane[1], layer - 1.0};
}

Wedge18::Shape Wedge18::shape(const Point& local) {
  const Triangle6::Shape plane = Triangle6::shape(local.head<2>());
  const Eigen::Vector3d along = line(local[2]);
  Shape n;
  for (int layer = 0; layer < 3; ++layer) n.segment<kLayer>(kLayer * layer) = along[layer] * plane;
  return n;
}

Wedge18::Gradients Wedge18::gradients(const Point& local) {
  const Triangle6::Shape plane = Triangle6::shape(local.head<2>());
  const Triangle6::Gradients slope = Triangle6::gradients(local.head<2>());
  const Eigen::Vector3d along = line(local[2]), derivative = line_derivative(local[2]);
  Gradients g;
  for (int layer = 0; layer < 3; ++layer) {
    g.block<kLayer, 2>(kLayer * layer, 0) = along[layer] * slope;
    g.block<kLayer, 1>(kLayer * layer, 2) = derivative[layer] * plane;
  }
  return g;
}

const std::array<std::array<int, 4>, 24>& Wedge18::simplices() {
  static const std::array<std::array<int, 4>, 24> result = [] {
    std::array<std::array<int, 4>, 24> list{};
    std::size_t k = 0;
    for (int layer = 0; layer < 2; ++layer)
      for (const std::array<int, 3>& triangle : Triangle6::simplices()) {
        const int a = triangle[0] + kLayer * layer, b = triangle[1] + kLayer * layer, c = triangle[2] + kLayer * layer;
        list[k++] = {a, b, c, a + kLayer};
        list[k++] = {b, c, a + kLayer, b + kLayer};
        list[k++] = {c, a + kLayer, b + kLayer, c + kLayer};
      }
    return list;
  }();
  return result;
}

const std::array<std::array<int, 9>, 3>& Wedge18::sides() {
  static const std::array<std::array<int, 9>, 3> result = [] {
    std::array<std::array<int, 9>, 3> list{};
    for (std::size_t side = 0; side < 3; ++side)
      for (std::size_t layer = 0; layer < 3; ++layer)
        for (std::size_t k = 0; k < 3; ++k)
          list[side][3 * layer + k] = Triangle6::sides()[side][k] + kLayer * static_cast<int>(layer);
    return list;
  }();
  return result;
}

}  // namespace dovetail::fem
