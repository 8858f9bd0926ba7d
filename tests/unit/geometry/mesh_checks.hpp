#pragma once

#include <array>
#include <cmath>
#include <map>
#include <span>
#include <utility>

#include "fem/mesh.hpp"
#include "geometry/profile/profile.hpp"

namespace dovetail::geometry {

/// Area enclosed by a chain of lines and arcs, by Green's theorem.
inline double exact_area(const Chain& chain) {
  double area = 0;
  for (const Edge& e : chain) {
    area += (e.start.x() * e.end.y() - e.start.y() * e.end.x()) / 2;
    if (e.is_arc()) area += e.radius * e.radius * (e.sweep - std::sin(e.sweep)) / 2;
  }
  return area;
}

/// Area of one body of a mesh; the three-point rule is exact for the Jacobian of a six-node triangle.
inline double mesh_area(const fem::Mesh& mesh, int body) {
  double area = 0;
  for (int e = 0; e < mesh.element_count(); ++e) {
    const std::span<const int> nodes = mesh.element(e);
    if (mesh.regions[static_cast<std::size_t>(mesh.region[static_cast<std::size_t>(e)])].body != body) continue;
    for (const auto& [r, s] : {std::pair{1.0 / 6, 1.0 / 6}, std::pair{2.0 / 3, 1.0 / 6}, std::pair{1.0 / 6, 2.0 / 3}}) {
      const double t = 1 - r - s;
      const std::array<double, 6> by_r{1 - 4 * t, 4 * r - 1, 0, 4 * (t - r), 4 * s, -4 * s};
      const std::array<double, 6> by_s{1 - 4 * t, 0, 4 * s - 1, -4 * r, 4 * r, 4 * (t - s)};
      Eigen::Vector2d xr(0, 0), xs(0, 0);
      for (std::size_t i = 0; i < 6; ++i) {
        xr += by_r[i] * mesh.nodes.col(nodes[i]);
        xs += by_s[i] * mesh.nodes.col(nodes[i]);
      }
      area += (xr.x() * xs.y() - xr.y() * xs.x()) / 6;
    }
  }
  return area;
}

/// How often every side (its two corners, the smaller first) is used, and its middle nodes.
struct SideUse {
  int count = 0;
  int middle = -1;
  bool one_middle = true;
};
inline std::map<std::pair<int, int>, SideUse> sides(const fem::Mesh& mesh) {
  std::map<std::pair<int, int>, SideUse> use;
  for (int e = 0; e < mesh.element_count(); ++e)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::span<const int> element = mesh.element(e);
      SideUse& side = use[std::minmax(element[i], element[(i + 1) % 3])];
      if (side.count++ > 0 && side.middle != element[3 + i]) side.one_middle = false;
      side.middle = element[3 + i];
    }
  return use;
}

}  // namespace dovetail::geometry
