#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <complex>

#include "fem/sector_mesh.hpp"

namespace dovetail::fem {

/// How the disk is held at its bore, the same at every nodal diameter. Axially it is held at SectorMesh::axial_nodes.
enum class BoreSupport {
  tangential,  ///< radially and axially free, no tangential displacement: a splined drum; stops the rigid rotation
  fixed,       ///< no displacement at all
  free,        ///< no support: nodal diameters 0 and 1 then have rigid motions
};

/// u_full = T x. Columns of T: internal dofs first, then the relative contact displacements, N, T1[, T2] of each
/// contact node in turn, flank by flank. With n, t1, t2 the flank's normal (out of the blade) and tangents,
///
///   u_blade = u_disk + n u_N + t1 u_T1 [+ t2 u_T2]        (u_N closing positive)
///
/// at every matched pair, u_N, u_T1, u_T2 interpolated between the contact nodes by Flank::interpolation. Cut nodes:
/// u_right = R u_left exp(i phase), R the rotation by -2 pi / sectors about z that carries the left cut onto the right
/// one and phase = 2 pi nodal_diameter / sectors. Bore nodes keep their radial (and axial) dof, see BoreSupport; axial
/// nodes have no u_z. A node on the right cut follows its partner, which must be supported in the same way; a blade
/// node of a flank follows the disk whatever its supports.
template <class Scalar>
struct Constraints {
  Eigen::SparseMatrix<Scalar> transformation;  ///< T [d n, m]
  Eigen::Index internal_count = 0;             ///< internal dofs
  Eigen::Index contact_count = 0;              ///< contact dofs, d per contact node; m is the sum

  [[nodiscard]] Eigen::Index size() const { return internal_count + contact_count; }
};

/// Real T: nodal diameter 0, and sectors/2 when their number is even. Throws InputError for other diameters
/// and for a mesh whose pairs do not match.
[[nodiscard]] Constraints<double> real_constraints(const SectorMesh& sector, BoreSupport bore = BoreSupport::tangential,
                                                   int nodal_diameter = 0);

/// Complex T for any nodal diameter 0..sectors/2.
[[nodiscard]] Constraints<std::complex<double>> complex_constraints(const SectorMesh& sector, BoreSupport bore,
                                                                    int nodal_diameter);

/// T^H A T, both triangles stored, exactly Hermitian. The pattern depends on the patterns of A and T only.
template <class Scalar>
[[nodiscard]] Eigen::SparseMatrix<Scalar> constrain(const Eigen::SparseMatrix<double>& full,
                                                    const Constraints<Scalar>& constraints);

extern template Eigen::SparseMatrix<double> constrain(const Eigen::SparseMatrix<double>&, const Constraints<double>&);
extern template Eigen::SparseMatrix<std::complex<double>> constrain(const Eigen::SparseMatrix<double>&,
                                                                    const Constraints<std::complex<double>>&);

}  // namespace dovetail::fem
