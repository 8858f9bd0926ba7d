#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <complex>
#include <span>
#include <vector>

#include "core/status.hpp"
#include "fem/constraints.hpp"
#include "numerics/sparse_modes.hpp"

namespace dovetail::fem {

/// Modes with the contact dofs at zero: the blade glued to the disk. `stiffness` and `mass` are over all nodes
/// (at speed: see stiffness_at_speed). Vectors are over the internal dofs, mass-normalised.
template <class Scalar>
[[nodiscard]] numerics::Modes<Scalar> glued_modes(const Eigen::SparseMatrix<double>& stiffness,
                                                  const Eigen::SparseMatrix<double>& mass,
                                                  const Constraints<Scalar>& constraints,
                                                  const numerics::ModesOptions& options,
                                                  numerics::SparseCholesky<Scalar>& cholesky);

extern template numerics::Modes<double> glued_modes(const Eigen::SparseMatrix<double>&,
                                                    const Eigen::SparseMatrix<double>&, const Constraints<double>&,
                                                    const numerics::ModesOptions&, numerics::SparseCholesky<double>&);
extern template numerics::Modes<std::complex<double>> glued_modes(const Eigen::SparseMatrix<double>&,
                                                                  const Eigen::SparseMatrix<double>&,
                                                                  const Constraints<std::complex<double>>&,
                                                                  const numerics::ModesOptions&,
                                                                  numerics::SparseCholesky<std::complex<double>>&);

/// Natural frequencies of the glued bladed disk over its nodal diameters.
struct NodalDiameterFrequencies {
  std::vector<int> nodal_diameters;
  Eigen::MatrixXd frequency;   ///< [diameters, modes] Hz, ascending; negative for -sqrt(-lambda)/(2 pi) (unstable)
  std::vector<Status> status;  ///< per diameter
};

/// Computes them for the diameters asked for (each 0..sectors/2), or all when the list is empty.
[[nodiscard]] NodalDiameterFrequencies nodal_diameter_frequencies(
    const SectorMesh& sector, const Eigen::SparseMatrix<double>& stiffness, const Eigen::SparseMatrix<double>& mass,
    BoreSupport bore, const numerics::ModesOptions& options, std::span<const int> nodal_diameters = {});

}  // namespace dovetail::fem
