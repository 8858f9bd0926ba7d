#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <cstdint>
#include <span>
#include <vector>

#include "reduction/structure_matrices.hpp"

namespace dovetail::reduction {

/// Where two bodies meet: Nc pairs of nodes in the same place, in d = 2 or 3 directions.
struct NodePairs {
  std::vector<std::int64_t> nodes;    ///< [Nc] of the one body, each once
  std::vector<std::int64_t> against;  ///< [Nc] of the other; empty, or 0: rigid ground
  Eigen::MatrixXd normal;             ///< [Nc, d] out of the one body, into the other; of any length
  Eigen::MatrixXd tangent;            ///< [Nc, d] of T1, as far as it is normal to that; no rows: chosen
};

/// T [dofs, n] of u = T [rest; r]: the rest are all degrees of freedom but those of `nodes`, in their order, and r the
/// relative displacements u_N, u_T1[, u_T2] of each pair in turn, u_node = u_against + R^T r with R orthonormal rows.
/// With r = 0 the bodies are glued. Throws InputError for nodes that the structure has not in all directions, nodes
/// listed twice, and a normal without a direction.
[[nodiscard]] Eigen::SparseMatrix<double> relative_coordinates(std::span<const NodeDirection> dofs,
                                                               const NodePairs& pairs);

}  // namespace dovetail::reduction
