#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <string>

namespace dovetail::geometry {

/// Corners, counter-clockwise seen from outside, m.
using Triangle = std::array<Eigen::Vector3d, 3>;

/// A binary STL file in mm, normals outwards. Its numbers have single precision.
[[nodiscard]] std::string stl(std::span<const Triangle> triangles);

}  // namespace dovetail::geometry
