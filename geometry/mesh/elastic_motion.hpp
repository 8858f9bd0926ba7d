#pragma once

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <vector>

#include "geometry/mesh/corner_mesh.hpp"

namespace dovetail::geometry {

/// Carries the interior nodes of a body along with its boundary: `K_ii u_i = -K_ib u_b`, K the
/// plane-strain stiffness of linear triangles on the reference mesh with Poisson's ratio 0.3 and Young's
/// modulus 1/area. Linear in u_b and exact for rigid displacements. Factorised once.
class ElasticMotion {
 public:
  explicit ElasticMotion(const CornerMesh& reference, const std::vector<int>& prescribed);

  /// Positions [2, nodes] of all corner nodes when the prescribed ones (order as given) are at `positions`.
  [[nodiscard]] Eigen::Matrix2Xd positions(const Eigen::Matrix2Xd& prescribed_positions) const;

 private:
  Eigen::Matrix2Xd reference_;
  std::vector<int> prescribed_, free_;
  Eigen::SparseMatrix<double> coupling_;  // K_ib
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor_;
};

}  // namespace dovetail::geometry
