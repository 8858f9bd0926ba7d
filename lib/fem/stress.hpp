#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <span>

#include "fem/assembly.hpp"
#include "fem/material.hpp"
#include "fem/mesh.hpp"

namespace dovetail::fem {

/// Stress (xx, yy, xy) at the quadrature points of every element for displacements u [2n], Pa.
[[nodiscard]] StressField quadrature_stress(const Mesh& mesh, std::span<const Material> materials,
                                            const Eigen::Ref<const Eigen::VectorXd>& displacement);

/// S [3 nn, 2n]: rows 3 k .. 3 k + 2 give (xx, yy, xy) at node nodes[k], Pa, as S u. Each element's strains are
/// evaluated at the node itself and averaged with equal weights over the elements that touch it; at a
/// boundary between regions of different thickness or material that average is across the jump.
/// Linear: static and dynamic parts may be combined before invariants are taken.
[[nodiscard]] Eigen::SparseMatrix<double> nodal_stress_operator(const Mesh& mesh, std::span<const Material> materials,
                                                                std::span<const int> nodes);

/// Invariants of a plane stress state. Plane strain adds sigma_zz = nu (sxx + syy); for a plane-stress region pass
/// nu = 0.
[[nodiscard]] double von_mises(double sxx, double syy, double sxy, double poisson_ratio);
/// The larger principal stress in the plane, Pa.
[[nodiscard]] double max_principal(double sxx, double syy, double sxy);

/// d von_mises / d(sxx, syy, sxy); zero where the stress vanishes.
[[nodiscard]] Eigen::Vector3d von_mises_gradient(double sxx, double syy, double sxy, double poisson_ratio);

}  // namespace dovetail::fem
