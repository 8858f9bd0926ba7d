#pragma once

#include <Eigen/Core>
#include <vector>

#include "dynamics/harmonic_matrices.hpp"

namespace dovetail::steady {

/// J = Z + D (eps I - Z) in its blocks: Z block-diagonal over harmonics, D over contact nodes. Views of matrices that
/// must outlive it. With n contact dofs, node by node with d directions, vec(U) has index k n + a for Fourier
/// coefficient k of dof a; a node's block orders its m = d (2H+1) coefficients as k d + r.
struct JacobianBlocks {
  const dynamics::HarmonicMatrices* stiffness;     ///< Z_h [n, n], H+1 of them
  std::vector<const Eigen::MatrixXd*> derivative;  ///< D [m, m], one per node
  Eigen::VectorXd penalty;                         ///< eps [n]

  [[nodiscard]] Eigen::Index size() const { return penalty.size(); }  ///< n
  [[nodiscard]] Eigen::Index coefficients() const { return stiffness->coefficients(); }
  [[nodiscard]] Eigen::Index directions() const {
    return derivative.empty() ? 1 : size() / static_cast<Eigen::Index>(derivative.size());
  }
};

/// Writes rows `rows` of J, with D replaced by D + regularisation (I - D), into columns[c] + position of the row: one
/// pointer per column of vec(U), null for columns that nobody wants. No product of full size is formed:
/// O(rows n d (2H+1)). Fastest when the rows of a node stand together.
void assemble(const JacobianBlocks& blocks, const std::vector<Eigen::Index>& rows, const std::vector<double*>& columns,
              double regularisation = 0);

/// D X, node by node; `adjoint`: its transpose.
[[nodiscard]] Eigen::MatrixXd apply_derivative(const JacobianBlocks& blocks, const Eigen::MatrixXd& x, bool adjoint);
/// J X and J^T X. O(q (n^2 H + n d H^2)).
[[nodiscard]] Eigen::MatrixXd apply_jacobian(const JacobianBlocks& blocks, const Eigen::MatrixXd& x);
[[nodiscard]] Eigen::MatrixXd apply_jacobian_transposed(const JacobianBlocks& blocks, const Eigen::MatrixXd& x);

}  // namespace dovetail::steady
