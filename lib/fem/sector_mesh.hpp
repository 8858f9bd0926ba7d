#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "fem/mesh.hpp"

namespace dovetail::fem {

/// One bearing flank of the joint: matched node pairs {blade node, disk node} at the same place, in
/// order from the neck side to the root side. Corner nodes carry the contact: the relative
/// displacement is linear between neighbouring corner pairs, also at the mid-side pairs, so nodal
/// areas are positive and pressures do not zigzag.
struct Flank {
  std::string name;                              ///< "left" or "right"
  std::vector<std::array<int, 2>> corner_pairs;  ///< [m]
  std::vector<std::array<int, 2>> middle_pairs;  ///< [m-1], between corner pairs i and i+1
  Eigen::Vector2d normal;                        ///< unit, out of the blade into the disk
  Eigen::Vector2d tangent;                       ///< unit, along the flank from neck to root side
  Eigen::VectorXd gap;                           ///< [m] initial gap g of the unloaded surfaces, m, smallest 0
};

/// The mesh of one sector of the bladed disk with everything the finite elements need to know about
/// its boundary. x is the tangential direction at the sector's centre line, y the radial one; the
/// axis of rotation is the origin.
struct SectorMesh {
  Mesh mesh;
  std::vector<Flank> flanks;                     ///< left, right
  std::vector<std::array<int, 2>> cyclic_pairs;  ///< {node on the left cut, node on the right cut};
                                                 ///< right = left rotated by -2 pi / sectors (clockwise)
  std::vector<int> bore_nodes;                   ///< nodes on the bore arc
  int tip_node = -1;                             ///< middle of the aerofoil tip: force and monitored output
  std::vector<int> blade_fillet_nodes;           ///< nodes on the blade's neck fillets (stress is read there)
  std::vector<int> disk_fillet_nodes;            ///< nodes on the slot fillets of the disk
  std::vector<int> neck_nodes;                   ///< the four points where the neck fillets end, lower ones first
  int sectors = 1;
};

}  // namespace dovetail::fem
