#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "reduction/residual_flexibility.hpp"

namespace dovetail::reduction {

/// A small change D of the stiffness since a structure was reduced, as reduced models take it to first order: what it
/// does on the fields X of unit forces on its trace and on the modes Phi of its basis. Contact nodes laid on the trace
/// take it from there, however often they are laid anew.
struct StiffnessChange {
  Eigen::SparseMatrix<double> whole;  ///< D [n, n], without zeros: a stress couples no directions
  Eigen::MatrixXd on_trace;           ///< [X, Phi]^T D [X, Phi] [nt + m, nt + m], symmetric

  /// [X A^T, Phi]^T D [X A^T, Phi] for contact nodes that are averages A [nc, nt] of the trace.
  [[nodiscard]] Eigen::MatrixXd on_contact(const Eigen::SparseMatrix<double>& average) const;
};

/// - `forced`: displacements to unit forces on the trace, X^T [nt, n]: all of an unknown lie together
[[nodiscard]] StiffnessChange stiffness_change(const ResidualFlexibility& structure,
                                               const Eigen::SparseMatrix<double>& change,
                                               const Eigen::MatrixXd& forced);

}  // namespace dovetail::reduction
