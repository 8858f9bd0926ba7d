#pragma once

#include <filesystem>
#include <string>

#include "fem/mesh.hpp"

namespace dovetail::geometry {

/// The surface of one body (0 blade, 1 disk) of a mesh of wedges as a binary STL file in mm, normals outwards. It goes
/// through all nodes, so its distance from the true surface is that of the mesh's half edges.
[[nodiscard]] std::string stl(const fem::Mesh& mesh, int body);

/// Writes that file beside its place and renames it. Throws InputError when it cannot be written or the mesh is plane.
void write_stl(const std::filesystem::path& file, const fem::Mesh& mesh, int body);

}  // namespace dovetail::geometry
