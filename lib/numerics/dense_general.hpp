#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/status.hpp"

// LAPACK's methods for matrices without symmetry, or of deficient rank.
namespace dovetail::numerics {

struct Eigenvalues {
  Status status = Status::converged;  ///< `not_finite`: the matrix is not; `stalled`: LAPACK failed
  Eigen::VectorXcd values;            ///< [n]
};
/// Eigenvalues of a square matrix, in no order (dgeev).
[[nodiscard]] Eigenvalues eigenvalues(Eigen::MatrixXd matrix);

/// The shortest X that minimises |A X - B|, by a complete orthogonal decomposition (dgelsy): directions of A below
/// `threshold` of the largest count as none.
[[nodiscard]] Eigen::MatrixXd least_squares(Eigen::MatrixXd a, const Eigen::MatrixXd& b, double threshold);

/// Columns that span all of them, the most independent first, by QR with pivoting (dgeqp3): what is left of the others
/// is below `threshold` of the largest.
[[nodiscard]] std::vector<Eigen::Index> independent_columns(Eigen::MatrixXd matrix, double threshold);

}  // namespace dovetail::numerics
