#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "numerics/nearest_modes.hpp"

namespace dovetail::numerics {

/// Vectors at once for large bodies.
constexpr int kLargeBlock = 16;

/// What nearest_modes asks for, by a block Krylov method [Golub & Underwood 1977] with the restart of Stewart's
/// Krylov-Schur method [2001] and full M-orthogonalisation: `inverse.perform_block` solves for `block` vectors at
/// once (0: kLargeBlock), which for supernodal factors of large bodies costs a fifth of solving for each alone.
/// Eigenvalues of a multiplicity up to the size of the block come out together; no deflation and no further look are
/// needed. A mode is taken when its residual |(K - sigma M)^{-1} M v - theta v|_M is below tolerance |theta|.
///
/// Start vectors are fixed. Cost: some 3 (block of 4) to 7 (of 16) solves per mode, three M products per block. Memory:
/// under 4 count + 6 block vectors. At most 3 vector_limit count + 400 solves. Statuses: `iteration_limit`,
/// `not_finite`.
template <class Scalar>
[[nodiscard]] Modes<Scalar> block_modes(const ShiftInverse<Scalar>& inverse, const Eigen::SparseMatrix<Scalar>& mass,
                                        const ModesOptions& options);

extern template Modes<double> block_modes(const ShiftInverse<double>&, const Eigen::SparseMatrix<double>&,
                                          const ModesOptions&);
extern template Modes<std::complex<double>> block_modes(const ShiftInverse<std::complex<double>>&,
                                                        const Eigen::SparseMatrix<std::complex<double>>&,
                                                        const ModesOptions&);

}  // namespace dovetail::numerics
