#pragma once

#include <Eigen/Core>
#include <functional>

namespace dovetail::reduction {

/// Field of the full model from the coordinates of a reduced one and its contact forces: linear in both, with an
/// offset for loads that the coordinates leave out. Back-solves with factors that the recovery shares with the model
/// it comes from, so nothing of the size of the full model is stored for each coordinate.
struct Recovery {
  using Columns = Eigen::Ref<const Eigen::MatrixXd>;
  std::function<Eigen::MatrixXd(const Columns& q, const Columns& lambda)> linear;  ///< see `apply`
  Eigen::VectorXd offset;  ///< [n] field of the static load alone, or empty (none)

  /// u [n, k]. Columns are load cases or Fourier coefficients: `q` [n_red, k] reduced coordinates, `lambda` [nc, k]
  /// contact forces in the order of the contact dofs, or empty for none of them (static condensation needs none); the
  /// offset times `offset_scale` is added to every column. Cost: one back-solve per column.
  [[nodiscard]] Eigen::MatrixXd apply(const Columns& q, const Columns& lambda, double offset_scale = 1) const {
    Eigen::MatrixXd field = linear(q, lambda);
    if (offset.size() > 0) field.colwise() += offset_scale * offset;
    return field;
  }
};

}  // namespace dovetail::reduction
