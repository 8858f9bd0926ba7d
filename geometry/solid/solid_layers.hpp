#pragma once

#include <vector>

#include "fem/sector_mesh.hpp"

namespace dovetail::geometry {

/// The topology of a plane sector mesh laid down at 2 layers + 1 heights (ends and middles of the layers, rising z):
/// 18-node wedges, node i at height l has the number l * (plane nodes) + i. Every list of nodes or pairs is repeated
/// at every height, lowest first, except the tip node and the neck nodes (middle height). The axial nodes are those of
/// the bore: a drum holds it over its whole width, so that the disk does not wobble like an umbrella in the range of
/// the blade's first modes. Positions, and the flanks but for their names and pairs, stay empty.
[[nodiscard]] fem::SectorMesh solid_layers(const fem::SectorMesh& plane, int layers);

}  // namespace dovetail::geometry
