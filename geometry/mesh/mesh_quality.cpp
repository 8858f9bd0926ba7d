#include "geometry/mesh/mesh_quality.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "fem/element.hpp"

namespace dovetail::geometry {
namespace {

using Eigen::Vector3d;
/// Vectors along the sides 01, 12, 20 of a triangle.
using Sides = std::array<Vector3d, 3>;

template <class Element>
std::vector<typename Element::Gradients> sample_gradients() {
  std::vector<typename Element::Gradients> samples;
  for (const auto& point : Element::quadrature()) samples.push_back(Element::gradients(point.local));
  typename Element::Point centre = Element::Point::Zero();
  centre[0] = centre[1] = 1.0 / 3;
  samples.push_back(Element::gradients(centre));
  for (int i = 0; i < Element::kNodes; ++i) samples.push_back(Element::gradients(Element::node(i)));
  return samples;
}

/// The triangles through the corners: one, or those at both ends of a wedge.
template <class Element>
std::vector<Sides> corner_triangles(const fem::ElementNodes<Element>& x) {
  const auto at = [&x](int i) {
    Vector3d point = Vector3d::Zero();
    point.head<Element::kDimensions>() = x.col(i);
    return point;
  };
  const auto sides = [&at](int i) { return Sides{at(i + 1) - at(i), at(i + 2) - at(i + 1), at(i) - at(i + 2)}; };
  if constexpr (Element::kDimensions == 2)
    return {sides(0)};
  else
    return {sides(0), sides(12)};
}

/// Determinant of the Jacobian of the ideal element of this size.
template <class Element>
double ideal(const fem::ElementNodes<Element>& x, const std::vector<Sides>& triangles) {
  std::array<double, 3> lengths{};
  for (const Sides& sides : triangles)
    for (std::size_t i = 0; i < 3; ++i) lengths[i] += sides[i].norm() / static_cast<double>(triangles.size());
  std::sort(lengths.begin(), lengths.end());
  double volume = std::numbers::sqrt3 / 2 * lengths[1] * lengths[2];
  if constexpr (Element::kDimensions == 3) {
    double height = 0;
    for (int i = 0; i < 3; ++i) height += (x.col(12 + i) - x.col(i)).norm() / 6;
    volume *= height;
  }
  return volume;
}

void add_angles(const Sides& sides, MeshQuality& quality) {
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3d &from = sides[(i + 2) % 3], &to = sides[i];
    const double angle = std::atan2(from.cross(to).norm(), -from.dot(to));
    quality.minimum_angle = std::min(quality.minimum_angle, angle);
    quality.maximum_angle = std::max(quality.maximum_angle, angle);
  }
}

template <class Element>
void assess_element(const fem::Mesh& mesh, int e, MeshQuality& quality) {
  static const std::vector<typename Element::Gradients> samples = sample_gradients<Element>();
  const fem::ElementNodes<Element> x = fem::element_nodes<Element>(mesh, e);
  double smallest = std::numeric_limits<double>::infinity();
  for (const typename Element::Gradients& g : samples) {
    const Eigen::Matrix<double, Element::kDimensions, Element::kDimensions> jacobian = x * g;
    smallest = std::min(smallest, jacobian.determinant());
  }
  const std::vector<Sides> triangles = corner_triangles<Element>(x);
  const double scaled = smallest / ideal<Element>(x, triangles);
  // Written so that a NaN counts as inverted.
  if (!(smallest > 0)) ++quality.inverted_elements;
  if (!(scaled >= quality.minimum_scaled_jacobian)) quality.minimum_scaled_jacobian = scaled;
  for (const Sides& sides : triangles) add_angles(sides, quality);
}

template <class Element>
double measure(const fem::Mesh& mesh, int e) {
  const fem::ElementNodes<Element> x = fem::element_nodes<Element>(mesh, e);
  double sum = 0;
  for (const auto& point : Element::quadrature()) {
    const Eigen::Matrix<double, Element::kDimensions, Element::kDimensions> jacobian =
        x * Element::gradients(point.local);
    sum += point.weight * jacobian.determinant();
  }
  return sum;
}

}  // namespace

MeshQuality assess(const fem::Mesh& mesh) {
  MeshQuality quality{.minimum_scaled_jacobian = std::numeric_limits<double>::infinity(),
                      .minimum_angle = std::numbers::pi,
                      .maximum_angle = 0};
  fem::with_element(mesh.kind, [&]<class Element>(Element) {
    for (int e = 0; e < mesh.element_count(); ++e) assess_element<Element>(mesh, e, quality);
  });
  return quality;
}

bool acceptable(const MeshQuality& quality, const MeshLimits& limits) {
  return quality.inverted_elements == 0 && quality.minimum_scaled_jacobian >= limits.minimum_scaled_jacobian &&
         quality.minimum_angle >= limits.minimum_angle;
}

double measure_of_body(const fem::Mesh& mesh, int body) {
  return fem::with_element(mesh.kind, [&]<class Element>(Element) {
    double sum = 0;
    for (int e = 0; e < mesh.element_count(); ++e)
      if (mesh.region_of(e).body == body) sum += measure<Element>(mesh, e);
    return sum;
  });
}

}  // namespace dovetail::geometry
