#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "geometry/mesh/size_field.hpp"

namespace dovetail::geometry {

/// Straight-sided triangles, counter-clockwise.
struct Triangulation {
  std::vector<Eigen::Vector2d> points;  ///< the given boundary first, in the given order, then interior points
  std::vector<std::array<int, 3>> triangles;
};

/// Fills a simple polygon (counter-clockwise) with triangles of the wanted size. The boundary is never
/// split. Interior points are circumcentres of too large triangles of the constrained Delaunay
/// triangulation, kept clear of the boundary, then relaxed towards the centroids of their
/// neighbourhoods (weighted so that the size field is respected). Deterministic.
/// Throws InputError when the polygon crosses or touches itself. Cost about 0.1 s for 2000 points.
[[nodiscard]] Triangulation triangulate(const std::vector<Eigen::Vector2d>& boundary, const SizeField& size);

}  // namespace dovetail::geometry
