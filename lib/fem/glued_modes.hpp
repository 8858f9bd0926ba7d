#pragma once

#include <Eigen/SparseCore>

#include "fem/constraints.hpp"
#include "numerics/sparse_modes.hpp"

namespace dovetail::fem {

/// Modes with the contact dofs at zero: the blade glued to the disk. `stiffness` and `mass` are over all nodes
/// (at speed: see stiffness_at_speed). Vectors are over the internal dofs, mass-normalised.
template <class Scalar>
[[nodiscard]] numerics::Modes<Scalar> glued_modes(const Eigen::SparseMatrix<double>& stiffness,
                                                  const Eigen::SparseMatrix<double>& mass,
                                                  const Constraints<Scalar>& constraints,
                                                  const numerics::ModesOptions& options,
                                                  numerics::SparseCholesky<Scalar>& cholesky) {
  // Columns of the contact dofs never enter: constrain with those of the internal dofs only.
  Constraints<Scalar> glued;
  glued.transformation = constraints.transformation.leftCols(constraints.internal_count);
  glued.internal_count = constraints.internal_count;
  return numerics::smallest_modes<Scalar>(constrain(stiffness, glued), constrain(mass, glued), options, cholesky);
}

}  // namespace dovetail::fem
