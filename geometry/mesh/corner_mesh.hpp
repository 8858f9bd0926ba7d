#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "geometry/profile/parameters.hpp"
#include "geometry/profile/profile.hpp"

namespace dovetail::geometry {

/// The corner nodes and triangles of one body, and where its boundary nodes sit on the chain.
struct CornerMesh {
  std::vector<Eigen::Vector2d> nodes;  ///< positions in the reference design, m
  std::vector<std::array<int, 3>> triangles;
  std::vector<int> region;                     ///< [triangles] 0 root or disk, 1 aerofoil
  std::vector<std::vector<double>> fractions;  ///< [edges of the chain][nodes on it] 0 ... 1
  std::vector<std::vector<int>> edge_nodes;    ///< the nodes at these fractions, start to end
  std::vector<int> aerofoil_root;              ///< blade: right end, middle, left end of the aerofoil's first line

  /// The node in the middle of the chain's far edge (aerofoil tip, slot floor).
  [[nodiscard]] int far_middle() const;
};

/// Positions in another design of the nodes that follow the chain: its boundary and the line between
/// platform and aerofoil. Index and position, each node once.
struct Prescribed {
  std::vector<int> nodes;
  Eigen::Matrix2Xd positions;
};
[[nodiscard]] Prescribed prescribed_nodes(const CornerMesh& mesh, const Chain& chain);

/// Meshes a body whose chain is mirror-symmetric about x = 0: edge i mirrors edge n - i, edge 0 and edge
/// n/2 cross the centre line. Only the right half is triangulated, so the mesh is a mirror image of
/// itself. Division of the boundary:
/// - flanks: at the fractions `flank` (flank_fractions.hpp);
/// - aerofoil ("aerofoil_right", "aerofoil_left"): aerofoil_elements equal edges along the span, two
///   elements through the thickness, middle nodes staggered against those of the sides;
/// - everything else: edges in proportion to the local size of element_sizes().
/// Throws InputError when the boundary crosses itself.
[[nodiscard]] CornerMesh mesh_corners(const Chain& chain, const MeshSizes& sizes, const std::vector<double>& flank);

}  // namespace dovetail::geometry
