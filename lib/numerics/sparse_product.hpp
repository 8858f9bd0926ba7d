#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace dovetail::numerics {

/// Dense matrices, row by row: a row of a block of columns lies together.
using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// A X, some columns of X at once: every entry of A is read once for all of them. Eigen takes one column after the
/// other, or as many as there are without knowing how many, at about twice the instructions.
[[nodiscard]] Rows product(const Eigen::SparseMatrix<double, Eigen::RowMajor>& a, const Rows& x);

/// The same with a symmetric A, whose columns are its rows.
[[nodiscard]] Eigen::MatrixXd symmetric_product(const Eigen::SparseMatrix<double>& a, const Eigen::MatrixXd& x);

/// X A X^T with a symmetric A, whose columns are its rows. Empty ones cost nothing.
[[nodiscard]] Eigen::MatrixXd congruent_by_rows(const Eigen::SparseMatrix<double>& a, const Eigen::MatrixXd& x);

}  // namespace dovetail::numerics
