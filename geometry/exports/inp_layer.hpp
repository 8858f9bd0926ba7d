#pragma once

#include "fem/sector_mesh.hpp"

namespace dovetail::geometry {

/// A plane section as one layer of 18-node wedges, as thick as its first region, in the middle of which lies z = 0.
/// axial_nodes are all nodes: u_z = 0 everywhere, plane strain. Regions of another thickness have to be made stiffer
/// and denser in proportion. Node n of the section becomes n, n + N, n + 2 N from the lower to the upper face, N the
/// number of nodes; the contact grid stays one line, its nodes in the plane z = 0.
[[nodiscard]] fem::SectorMesh inp_layer(const fem::SectorMesh& section);

}  // namespace dovetail::geometry
