#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <span>
#include <vector>

#include "fem/material.hpp"
#include "fem/mesh.hpp"

namespace dovetail::fem {

/// Stress (xx, yy, xy) at the quadrature points, Pa: [3, 6 elements], the six points of an element in a row.
using StressField = Eigen::Matrix3Xd;

/// Full matrices over all nodes, dof 2 i + c for component c of node i. They share one pattern (explicit
/// zeros included), so their values may be combined and a symbolic factorisation reused.
struct FullMatrices {
  Eigen::SparseMatrix<double> stiffness;  ///< [2n, 2n] N/m, both triangles
  Eigen::SparseMatrix<double> mass;       ///< [2n, 2n] kg
};

/// Knows the pattern of a mesh topology and where each element's entries go; fills in values for any node
/// positions. Materials are indexed by Region::body. Throws InputError for bad connectivity, thickness or
/// material, and for inverted elements.
class Assembler {
 public:
  explicit Assembler(const Mesh& mesh);

  /// `mesh` must have the topology given to the constructor.
  [[nodiscard]] FullMatrices stiffness_and_mass(const Mesh& mesh, std::span<const Material> materials) const;

  /// Stiffness due to an initial stress: u^T K_g u = integral of sigma_ij u_k,i u_k,j. N/m, the same pattern.
  [[nodiscard]] Eigen::SparseMatrix<double> geometric_stiffness(const Mesh& mesh, const StressField& stress) const;

  [[nodiscard]] const Eigen::SparseMatrix<double>& pattern() const { return pattern_; }

 private:
  void scatter(const Mesh& mesh, std::size_t element, const double* values, double* target) const;

  Eigen::SparseMatrix<double> pattern_;
  std::vector<int>
      position_;  ///< [elements, 6, 6] first value of node block (a, b) in column 2 b; the second column follows
  std::vector<int> column_length_;
  std::size_t elements_ = 0;
};

/// f = M r with the position vectors r from the axis: centrifugal load for Omega^2 = 1, N/(rad/s)^2. Exact to
/// the element's quadrature because positions are interpolated like displacements. The load's change with
/// displacement is the spin softening -Omega^2 M.
[[nodiscard]] Eigen::VectorXd centrifugal_load(const Eigen::SparseMatrix<double>& mass, const Mesh& mesh);

/// Mass of all regions of a body, kg (of one sector).
[[nodiscard]] double body_mass(const Mesh& mesh, std::span<const Material> materials, int body);

}  // namespace dovetail::fem
