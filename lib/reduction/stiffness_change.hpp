#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "numerics/sparse_product.hpp"
#include "reduction/residual_flexibility.hpp"

namespace dovetail::reduction {

/// A small change D of the stiffness since a structure was reduced, as reduced models take it to first order: what it
/// does on the modes of its basis and on the fields of unit forces on its trace. Of the latter only what contact nodes
/// see of them is ever asked for, which are fewer: X is kept, not X^T D X.
struct StiffnessChange {
  Eigen::SparseMatrix<double> whole;                     ///< D [n, n]
  Eigen::MatrixXd on_basis;                              ///< Phi^T D Phi [m, m]
  Eigen::SparseMatrix<double, Eigen::RowMajor> on_rows;  ///< D on the r rows on which it is not negligible [r, r]
  numerics::Rows fields;                                 ///< X^T there [nt, r]
  Eigen::MatrixXd of_basis;                              ///< D Phi there [r, m]

  /// [X A^T, Phi]^T D [X A^T, Phi] for contact nodes that are averages A [nc, nt] of the trace.
  [[nodiscard]] Eigen::MatrixXd on_contact(const Eigen::SparseMatrix<double>& average) const;
};

/// - `forced`: displacements to unit forces on the trace, X [n, nt]
[[nodiscard]] StiffnessChange stiffness_change(const ResidualFlexibility& structure, Eigen::SparseMatrix<double> change,
                                               const Eigen::MatrixXd& forced);

}  // namespace dovetail::reduction
