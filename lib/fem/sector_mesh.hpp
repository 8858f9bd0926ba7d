#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <array>
#include <string>
#include <vector>

#include "fem/mesh.hpp"

namespace dovetail::fem {

/// One bearing flank of the joint. Contact lives on a grid of contact nodes along the flank and, in space, along the
/// slot; between them the relative displacement is linear (bilinear). The matched node pairs of the mesh follow it,
/// mid-sides and face centres too, so nodal areas are positive and pressures do not zigzag. The grid need not consist
/// of nodes of the mesh, but a finer one than the mesh's corner nodes leaves contact nodes without stiffness.
struct Flank {
  std::string name;               ///< "left" or "right"
  std::array<int, 2> grid{0, 1};  ///< contact nodes along the flank (neck to root side) and along the slot (1 in the
                                  ///< plane); node (i, j) has the number i + grid[0] j
  Eigen::MatrixXd position;       ///< [d, m] contact nodes, m = grid[0] grid[1]
  std::vector<std::array<int, 2>> pairs;      ///< [p] all matched pairs {blade node, disk node} at the same place
  Eigen::SparseMatrix<double> interpolation;  ///< [p, m] relative displacement of a pair from those of the contact
                                              ///< nodes; entries >= 0, rows sum to 1
  Eigen::VectorXd normal;                     ///< [d] unit, out of the blade into the disk
  Eigen::MatrixXd tangents;  ///< [d, d-1] orthonormal, orthogonal to the normal: T1 from neck to root side, in space
                             ///< across the slot; T2 along the slot (towards +z)
  Eigen::VectorXd gap;       ///< [m] initial gap g of the unloaded surfaces, m, smallest 0; empty: none
  Eigen::VectorXd pair_gap;  ///< [p] the same at every matched pair; empty: as interpolated from `gap`

  [[nodiscard]] int contact_count() const { return grid[0] * grid[1]; }  ///< m
};

/// The mesh of one sector of the bladed disk with everything the finite elements need to know about
/// its boundary. x is the tangential direction at the sector's centre line, y the radial one, z the axial one; the
/// axis of rotation is the z axis, in the plane the origin.
struct SectorMesh {
  Mesh mesh;
  std::vector<Flank> flanks;                     ///< left, right
  std::vector<std::array<int, 2>> cyclic_pairs;  ///< {node on the left cut, node on the right cut};
                                                 ///< right = left rotated by -2 pi / sectors about z (clockwise)
  std::vector<int> bore_nodes;                   ///< nodes on the bore
  int tip_node = -1;                             ///< middle of the aerofoil tip: force and monitored output
  std::vector<int> blade_fillet_nodes;           ///< nodes on the blade's neck fillets (stress is read there)
  std::vector<int> disk_fillet_nodes;            ///< nodes on the slot fillets of the disk
  Eigen::VectorXd blade_fillet_share;  ///< [blade_fillet_nodes] 0 ... 1: how much the stress there counts as the
                                       ///< fillet's; 0 at the end of the flank, where pressure and stress are singular
  Eigen::VectorXd disk_fillet_share;   ///< [disk_fillet_nodes] the same
  std::vector<int> neck_nodes;         ///< the four points where the neck fillets end, lower ones first; in
                                       ///< space those of one cross-section
  std::vector<int> axial_nodes;        ///< space: nodes with u_z = 0, the disk's axial support (blade nodes of
                                       ///< a flank do not count: they follow their partners)
  int sectors = 1;
};

}  // namespace dovetail::fem
