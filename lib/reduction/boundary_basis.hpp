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
[[nodiscard]] RitzBasis rayleigh_ritz(const Eigen::SparseMatrix<double>& stiffness,
                                      const Eigen::SparseMatrix<double>& mass, const Eigen::MatrixXd& vectors);

}  // namespace dovetail::reduction
