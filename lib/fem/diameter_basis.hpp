#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <complex>
#include <optional>
#include <vector>

#include "fem/constraints.hpp"
#include "fem/sector_mesh.hpp"

namespace dovetail::fem {

/// A(phase) = A0 + e^{i phase} A1 + e^{-i phase} A1^T over the dofs of the glued joint, in which A1 has few entries.
struct PhaseMatrix {
  Eigen::SparseMatrix<double> constant, turning;

  /// At the phases 0 and pi, where it is real.
  [[nodiscard]] Eigen::SparseMatrix<double> alike() const;
  [[nodiscard]] Eigen::SparseMatrix<double> against() const;
};

/// Rayleigh-Ritz at any phase between neighbouring sectors on a growing real basis. Its matrices are products with a
/// basis that does not depend on the phase: a phase costs a dense eigenproblem.
class DiameterBasis {
 public:
  /// - `flexibility`: of springs between the flanks, see DiameterOptions
  DiameterBasis(const SectorMesh& sector, const Eigen::SparseMatrix<double>& stiffness,
                const Eigen::SparseMatrix<double>& mass, BoreSupport bore, const Eigen::VectorXd& flexibility);

  [[nodiscard]] const PhaseMatrix& stiffness() const { return stiffness_->matrix; }
  [[nodiscard]] const PhaseMatrix& mass() const { return mass_->matrix; }

  /// Vectors that turn by `phase` more from one sector to the next, evenly over each: what solves a problem of one
  /// phase nearly does so of another when it is turned there. At the cuts exactly, so that what is left is smooth.
  [[nodiscard]] Eigen::MatrixXcd turned(double phase, const Eigen::MatrixXcd& vectors) const;

  /// Real and imaginary parts of vectors, each as a direction alone, as far as it is a new one.
  void add(const Eigen::MatrixXd& vectors);
  void add(const Eigen::MatrixXcd& vectors);

  /// The lowest `count` eigenvalues; empty where there are none.
  [[nodiscard]] Eigen::VectorXd eigenvalues(double phase, Eigen::Index count) const;

  /// K V - M V diag(values) of the lowest `count` Ritz pairs; empty where there are none.
  [[nodiscard]] Eigen::MatrixXcd residuals(double phase, Eigen::Index count) const;

 private:
  /// A matrix and what it makes of the basis B.
  struct OnBasis {
    PhaseMatrix matrix;
    Eigen::MatrixXd constant, turning;        ///< B^T A0 B, B^T A1 B
    std::vector<Eigen::Index> rows, columns;  ///< of A1 that are not empty: those at the cuts
    Eigen::SparseMatrix<double> cuts;         ///< A1 of these

    explicit OnBasis(PhaseMatrix of);
    [[nodiscard]] Eigen::MatrixXcd reduced(double phase) const;
    [[nodiscard]] Eigen::MatrixXcd times(double phase, const Eigen::MatrixXcd& vectors) const;
    /// `basis` has `fresh` more columns than at the last call.
    void grow(const Eigen::Ref<const Eigen::MatrixXd>& basis, Eigen::Index fresh);
  };

  [[nodiscard]] auto basis() const { return held_.leftCols(size_); }

  Eigen::VectorXd place_;  ///< [dofs] angle about the axis in the sense of the phase, over that of a sector
  std::optional<OnBasis> stiffness_, mass_;
  Eigen::MatrixXd held_;  ///< the basis, with room for more
  Eigen::Index size_ = 0;
};

}  // namespace dovetail::fem
