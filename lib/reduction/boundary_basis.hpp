#pragma once

#include <Eigen/Core>

#include "core/status.hpp"
#include "reduction/free_modes.hpp"
#include "reduction/full_model.hpp"

namespace dovetail::reduction {

/// Static responses K^-1 F to every load and output vector of the model that the modes do not already
/// represent, M-orthogonal to the modes and to each other, at most `limit` of them: [n, 0..limit].
[[nodiscard]] Eigen::MatrixXd static_responses(const FullModel& full, const FloatingInverse& inverse,
                                               const FreeModes& modes, Eigen::Index limit);

/// Rayleigh-Ritz pairs of (K, M) on the columns of `vectors`.
struct RitzBasis {
  Eigen::VectorXd eigenvalues;  ///< [m] ascending
  Eigen::MatrixXd vectors;      ///< [n, m] M-orthonormal, K-orthogonal
};
[[nodiscard]] RitzBasis rayleigh_ritz(const FullModel& full, const Eigen::MatrixXd& vectors);

/// (K^-1 - Phi Lambda^-1 Phi^T) B^T [n, nc]: displacement to unit contact forces beyond what the basis
/// represents. The `low` first pairs must be eigenpairs (rigid, negative and soft ones): they are constrained
/// to zero instead of subtracted, so that K may be singular and nothing large cancels.
struct ResidualFlexibility {
  Status status = Status::converged;
  Eigen::MatrixXd field;    ///< X [n, nc], m/N
  Eigen::MatrixXd contact;  ///< G = B X [nc, nc], symmetric
};
[[nodiscard]] ResidualFlexibility residual_flexibility(const ContactSolver& solver,
                                                       const Eigen::SparseMatrix<double>& mass, const RitzBasis& basis,
                                                       Eigen::Index low);

}  // namespace dovetail::reduction
