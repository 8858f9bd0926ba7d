#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace dovetail::reduction {

/// Field of the full model from the coordinates of a reduced one:
///   u = offset + basis * q[first : first + basis.cols()] + contact_response * lambda.
/// Rows are all n coordinates, or the results of the linear operator given to `project` (stresses, chosen
/// dofs), so that repeated recoveries cost only those rows.
struct Recovery {
  Eigen::MatrixXd basis;             ///< [rows, m]
  Eigen::Index first = 0;            ///< reduced coordinate that multiplies column 0 of `basis`
  Eigen::MatrixXd contact_response;  ///< [rows, nc], m/N, or empty (nothing depends on lambda)
  Eigen::VectorXd offset;            ///< [rows] field of the static load alone, or empty (none)

  [[nodiscard]] Eigen::Index rows() const { return basis.rows(); }

  /// Columns are load cases or Fourier coefficients. `q` [n_red, k] reduced coordinates, `lambda` [nc, k]
  /// contact forces in the order of the contact dofs (ignored, may be empty, when `contact_response` is
  /// empty); the offset times `offset_scale` is added to every column. Cost 2 rows (m + nc) k.
  [[nodiscard]] Eigen::MatrixXd apply(const Eigen::Ref<const Eigen::MatrixXd>& q,
                                      const Eigen::Ref<const Eigen::MatrixXd>& lambda, double offset_scale = 1) const;

  /// The same recovery of `rows_of_interest * u`, e.g. a stress operator or a selection of dofs.
  [[nodiscard]] Recovery project(const Eigen::SparseMatrix<double>& rows_of_interest) const;
};

}  // namespace dovetail::reduction
