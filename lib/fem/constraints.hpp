#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <complex>

#include "fem/sector_mesh.hpp"

namespace dovetail::fem {

/// How the disk is held at its bore, the same at every nodal diameter.
enum class BoreSupport {
  tangential,  ///< radially free, no tangential displacement: a splined drum; stops the rigid rotation
  fixed,       ///< no displacement at all
  free,        ///< no support: nodal diameters 0 and 1 then have rigid motions
};

/// u_full = T x. Columns of T: internal dofs first, then the relative contact displacements, N and T of
/// each corner pair in turn, flank by flank. With n, t the flank's normal (out of the blade) and tangent,
///
///   u_blade = u_disk + n u_N + t u_T        (u_N closing positive)
///
/// at corner pairs; at mid-side pairs with the mean of the two neighbouring corner pairs. Cut nodes:
/// u_right = R u_left exp(i phase), R the rotation by -2 pi / sectors that carries the left cut onto the right one
/// and phase = 2 pi nodal_diameter / sectors. Bore nodes keep their radial dof (see BoreSupport).
template <class Scalar>
struct Constraints {
  Eigen::SparseMatrix<Scalar> transformation;  ///< T [2n, m]
  Eigen::Index internal_count = 0;             ///< internal dofs
  Eigen::Index contact_count = 0;              ///< contact dofs, 2 per corner pair; m is the sum

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
