#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <span>
#include <vector>

#include "fem/material.hpp"
#include "fem/mesh.hpp"

namespace dovetail::fem {

/// Stress at the quadrature points, Pa: [3, 6 elements] (xx, yy, xy) in the plane, [6, 18 elements]
/// (xx, yy, zz, xy, yz, zx) in space, the points of an element in a row.
using StressField = Eigen::MatrixXd;

/// Full matrices over all nodes, dof d i + c for component c of node i in d dimensions. The stiffness holds explicit
/// zeros where elements couple, so that a symbolic factorisation may be reused; the mass couples equal components only,
/// and holds none.
struct FullMatrices {
  int dimensions = 2;                     ///< d
  Eigen::SparseMatrix<double> stiffness;  ///< [d n, d n] N/m, both triangles
  Eigen::SparseMatrix<double> mass;       ///< [d n, d n] kg
};

/// Knows the pattern of a mesh topology and where each element's entries go; fills in values for any node
/// positions. Materials are indexed by Region::body. Throws InputError for bad connectivity, thickness or
/// material, and for inverted elements.
class Assembler {
 public:
  explicit Assembler(const Mesh& mesh);

  /// Whether a mesh has the topology given to the constructor.
  [[nodiscard]] bool serves(const Mesh& mesh) const;

  /// `mesh` must have the topology given to the constructor.
  [[nodiscard]] FullMatrices stiffness_and_mass(const Mesh& mesh, std::span<const Material> materials) const;

  /// Stiffness due to an initial stress: u^T K_g u = integral of sigma_ij u_k,i u_k,j. N/m, the same pattern.
  [[nodiscard]] Eigen::SparseMatrix<double> geometric_stiffness(const Mesh& mesh, const StressField& stress) const;

 private:
  [[nodiscard]] Eigen::SparseMatrix<double> zeros() const;

  /// [elements, N, N] where the block of nodes (a, b) begins, b outer, in the first column of b; its next columns
  /// follow at distances of column_length_.
  std::vector<int> position_;
  std::vector<int> column_length_;  ///< [n]
  std::vector<int> connectivity_;
  Eigen::SparseMatrix<signed char> pattern_;  ///< zeros
  int elements_ = 0;
};

/// f = M r with the vectors r from the axis (x, y; z is along it): centrifugal load for Omega^2 = 1, N/(rad/s)^2. Exact
/// to the element's quadrature because positions are interpolated like displacements. The load's change with
/// displacement is the spin softening -Omega^2 M of x and y.
[[nodiscard]] Eigen::VectorXd centrifugal_load(const Eigen::SparseMatrix<double>& mass, const Mesh& mesh);

/// Mass of all regions of a body, kg (of one sector).
[[nodiscard]] double body_mass(const Mesh& mesh, std::span<const Material> materials, int body);

}  // namespace dovetail::fem
