#pragma once

#include <string>
#include <vector>

#include "fem/mesh.hpp"

namespace dovetail::geometry {

/// The closed surfaces of bodies (0 blade, 1 disk) of a mesh of wedges as a binary STL file in mm, normals outwards.
/// They go through all nodes, so their distance from the true surface is that of the mesh's half edges. Throws
/// InputError when the mesh is plane.
[[nodiscard]] std::string stl(const fem::Mesh& mesh, const std::vector<int>& bodies);

}  // namespace dovetail::geometry
