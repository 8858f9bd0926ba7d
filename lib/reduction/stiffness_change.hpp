#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "reduction/residual_flexibility.hpp"

namespace dovetail::reduction {

/// A small change D of the stiffness since a structure was reduced, as reduced models take it to first order: what it
/// does on the modes of its basis and on the fields of unit forces on its trace, X [n, nt].
struct StiffnessChange {
  Eigen::SparseMatrix<double> whole;  ///< D [n, n]
  Eigen::MatrixXd on_basis;           ///< Phi^T D Phi [m, m]
  Eigen::MatrixXd on_trace;           ///< X^T D X [nt, nt]
  Eigen::MatrixXd between;            ///< X^T D Phi [nt, m]
};

/// @param forced  displacements to unit forces on the trace, X [n, nt], or empty: a back-solve for each instead
[[nodiscard]] StiffnessChange stiffness_change(const ResidualFlexibility& structure, Eigen::SparseMatrix<double> change,
                                               const Eigen::MatrixXd& forced);

}  // namespace dovetail::reduction
