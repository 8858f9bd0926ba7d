#include "fem/neck.hpp"

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "core/errors.hpp"
#include "fem/element.hpp"

namespace dovetail::fem {

namespace {

/// Area and first moment of a part of the section.
struct Moments {
  double area = 0;
  Eigen::Vector2d first = Eigen::Vector2d::Zero();
};

Moments of_element(const ElementNodes& nodes) {
  Moments moments;
  for (const QuadraturePoint& point : quadrature()) {
    const double area = point.weight * plane_gradients(nodes, point.xi, point.eta).determinant;
    moments.area += area;
    moments.first += area * (nodes * shape_functions(point.xi, point.eta));
  }
  return moments;
}

/// The part with height > 0 of the hexagon through the element's six nodes, in boundary order.
Moments of_clipped(const ElementNodes& nodes, const Eigen::Matrix<double, 6, 1>& height) {
  constexpr std::array<int, 6> boundary{0, 3, 1, 4, 2, 5};
  std::vector<Eigen::Vector2d> polygon;
  for (std::size_t k = 0; k < 6; ++k) {
    const int a = boundary[k], b = boundary[(k + 1) % 6];
    if (height[a] > 0) polygon.push_back(nodes.col(a));
    if ((height[a] > 0) != (height[b] > 0))
      polygon.push_back(nodes.col(a) + (nodes.col(b) - nodes.col(a)) * (height[a] / (height[a] - height[b])));
  }
  Moments moments;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Eigen::Vector2d& p = polygon[k];
    const Eigen::Vector2d& q = polygon[(k + 1) % polygon.size()];
    const double cross = p.x() * q.y() - p.y() * q.x();
    moments.area += cross / 2;
    moments.first += cross / 6 * (p + q);
  }
  return moments;
}

}  // namespace

NeckTension neck_tension(const SectorMesh& sector, std::span<const Material> materials) {
  const Mesh& mesh = sector.mesh;
  if (sector.neck_nodes.size() != 4)
    throw InputError({.file = {},
                      .key = "sector.neck_nodes",
                      .value = std::to_string(sector.neck_nodes.size()),
                      .allowed = "must be four nodes, the lower two first"});
  const std::array<int, 2> upper{sector.neck_nodes[2], sector.neck_nodes[3]};
  const Eigen::Vector2d first = mesh.nodes.col(upper[0]), second = mesh.nodes.col(upper[1]);
  Eigen::Vector2d normal(first.y() - second.y(), second.x() - first.x());
  normal.normalize();
  if (normal.dot(first + second) < 0) normal = -normal;  // outwards

  NeckTension neck;
  neck.width = (second - first).norm();
  neck.thickness = std::numeric_limits<double>::infinity();
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const Region& region = mesh.regions[static_cast<std::size_t>(mesh.region[e])];
    if (region.body != 0) continue;
    for (int node : mesh.elements[e])
      if (node == upper[0] || node == upper[1]) neck.thickness = std::min(neck.thickness, region.thickness);
    const ElementNodes nodes = element_nodes(mesh, e);
    const Eigen::Matrix<double, 6, 1> height = (nodes.colwise() - first).transpose() * normal;
    if (height.maxCoeff() <= 0) continue;
    const Moments moments = height.minCoeff() >= 0 ? of_element(nodes) : of_clipped(nodes, height);
    const double density = materials[static_cast<std::size_t>(region.body)].density * region.thickness;
    neck.mass += density * moments.area;
    neck.force += density * moments.first;
  }
  if (!(neck.thickness < std::numeric_limits<double>::infinity()))
    throw InputError({.file = {},
                      .key = "sector.neck_nodes",
                      .value = std::to_string(upper[0]) + ", " + std::to_string(upper[1]),
                      .allowed = "must be nodes of the blade"});
  neck.tension = neck.force.dot(normal);
  neck.mean_stress = neck.tension / (neck.width * neck.thickness);
  return neck;
}

}  // namespace dovetail::fem
