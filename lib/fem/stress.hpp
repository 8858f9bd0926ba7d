#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <span>

#include "fem/assembly.hpp"
#include "fem/material.hpp"
#include "fem/mesh.hpp"

namespace dovetail::fem {

/// Stress at the quadrature points of every element for displacements u [d n], Pa.
[[nodiscard]] StressField quadrature_stress(const Mesh& mesh, std::span<const Material> materials,
                                            const Eigen::Ref<const Eigen::VectorXd>& displacement);

/// S [s nn, d n], s = 3 (xx, yy, xy) in the plane, 6 (xx, yy, zz, xy, yz, zx) in space: rows s k .. s k + s - 1 give
/// the stress at node nodes[k], Pa, as S u. Each element's strains are evaluated at the node itself and averaged with
/// equal weights over the elements that touch it; at a boundary between regions of different thickness or material that
/// average is across the jump. Linear: static and dynamic parts may be combined before invariants are taken.
[[nodiscard]] Eigen::SparseMatrix<double> nodal_stress_operator(const Mesh& mesh, std::span<const Material> materials,
                                                                std::span<const int> nodes);

/// Stress [s] at a surface with unit normal n [d] on which nothing acts, out of one [s] that nearly keeps that. Strains
/// along the surface stay as they are: on the side of an element they converge faster than those across it.
[[nodiscard]] Eigen::VectorXd on_free_surface(const Eigen::Ref<const Eigen::VectorXd>& stress,
                                              const Eigen::Ref<const Eigen::VectorXd>& normal, double poisson_ratio);

/// Stress [3] in the plane or [6] in space. Plane strain adds sigma_zz = nu (sxx + syy); for a plane-stress region pass
/// nu = 0. In space nu does not count.
using StressVector = Eigen::Ref<const Eigen::VectorXd>;
[[nodiscard]] double von_mises(const StressVector& stress, double poisson_ratio);

}  // namespace dovetail::fem
