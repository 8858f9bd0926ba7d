#pragma once

#include <Eigen/Core>

#include "core/status.hpp"

namespace dovetail::numerics {

/// Some eigenpairs of a symmetric matrix.
struct SymmetricPairs {
  Status status = Status::converged;  ///< `stalled`: LAPACK failed; there are no pairs then
  Eigen::VectorXd values;             ///< [k] ascending
  Eigen::MatrixXd vectors;            ///< [n, k] orthonormal
};

/// Those of eigenvalues <= `limit`; only the lower triangle is read. LAPACK's bisection: a fifth of the cost of a full
/// decomposition when they are few.
[[nodiscard]] SymmetricPairs pairs_up_to(Eigen::MatrixXd matrix, double limit);

/// Replaces a symmetric positive definite matrix, of which the lower triangle is read, by its inverse. `singular`: it
/// is not positive definite.
[[nodiscard]] Status invert_positive_definite(Eigen::MatrixXd& matrix);

}  // namespace dovetail::numerics
