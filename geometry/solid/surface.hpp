#pragma once

#include <array>
#include <vector>

#include "fem/mesh.hpp"

namespace dovetail::geometry {

/// The surface of one body of a mesh of wedges as flat triangles through the nodes (four for a six-node end, eight for
/// a nine-node side), counter-clockwise seen from outside. Order: by element, then face.
[[nodiscard]] std::vector<std::array<int, 3>> surface(const fem::Mesh& mesh, int body);

}  // namespace dovetail::geometry
