#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <complex>

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

}  // namespace dovetail::fem
