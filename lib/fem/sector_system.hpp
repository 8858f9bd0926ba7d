#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <span>

#include "fem/assembly.hpp"
#include "fem/constraints.hpp"
#include "fem/sector_mesh.hpp"

namespace dovetail::fem {

/// Contact nodes of a sector in the order of the contact dofs: flank by flank, in the order of the flank's grid.
struct ContactSurface {
  /// [Nc] m^2: integral over the blade's flank (in the plane times the slot length) of the contact node's hat, that is
  /// of Flank::interpolation between the nodes of the mesh. So a uniform pressure p gives the contact forces p area.
  Eigen::VectorXd area;
  Eigen::MatrixXd position;  ///< [d, Nc] m
  Eigen::VectorXi flank;     ///< [Nc] index into SectorMesh::flanks
  Eigen::VectorXd gap;       ///< [Nc] initial gap, m

  [[nodiscard]] Eigen::Index count() const { return area.size(); }
};

/// One sector at standstill, nodal diameter 0, in independent coordinates x = (internal, contact), u = T x.
/// At speed Omega the stiffness is `stiffness_at_speed`; the static load is Omega^2 centrifugal.
struct SectorSystem {
  FullMatrices full;                      ///< over all nodes
  Constraints<double> constraints;        ///< T
  Eigen::SparseMatrix<double> stiffness;  ///< [m, m] N/m
  Eigen::SparseMatrix<double> mass;       ///< [m, m] kg, without stored zeros
  Eigen::VectorXd centrifugal;            ///< [m] load for Omega^2 = 1, N/(rad/s)^2
  Eigen::VectorXd tip;  ///< [m] T^T of a unit tangential (x) force at the tip node; also the output vector
  ContactSurface contact;

  [[nodiscard]] Eigen::Index size() const { return constraints.size(); }
  [[nodiscard]] Eigen::Index internal_size() const { return constraints.internal_count; }
  [[nodiscard]] Eigen::Index contact_size() const { return constraints.contact_count; }
};

/// Without copies of the matrices, which std::swap makes.
void swap(SectorSystem& a, SectorSystem& b);

/// Assembles and constrains a sector. Throws InputError (see Assembler, real_constraints).
[[nodiscard]] SectorSystem build_sector_system(const SectorMesh& sector, std::span<const Material> materials,
                                               const Assembler& assembler, BoreSupport bore = BoreSupport::tangential);

/// K + K_g - Omega^2 M_xy over all nodes: K_g from the stresses of the preloaded state, spin softening in the
/// plane of rotation only. `omega` in rad/s. Both stiffnesses have one pattern, and the mass a part of it.
[[nodiscard]] Eigen::SparseMatrix<double> stiffness_at_speed(const FullMatrices& full,
                                                             const Eigen::SparseMatrix<double>& geometric,
                                                             double omega);

/// Areas, positions and gaps of the contact nodes. Throws InputError when the pairs of a flank do not cover whole sides
/// of elements.
[[nodiscard]] ContactSurface contact_surface(const SectorMesh& sector);

/// Thickness of the body that a node belongs to, m: of an element with that node; 1 in space.
[[nodiscard]] double body_thickness(const Mesh& mesh, int node);

}  // namespace dovetail::fem
