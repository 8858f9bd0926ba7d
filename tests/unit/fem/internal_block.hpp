#pragma once

#include "fem/sector_system.hpp"

namespace dovetail::fem {

/// The block of the internal dofs: contact dofs held at zero, the blade glued to the disk.
template <class Scalar>
[[nodiscard]] Eigen::SparseMatrix<Scalar> internal_block(const Eigen::SparseMatrix<Scalar>& matrix,
                                                         const Constraints<Scalar>& constraints) {
  return matrix.topLeftCorner(constraints.internal_count, constraints.internal_count);
}

}  // namespace dovetail::fem
