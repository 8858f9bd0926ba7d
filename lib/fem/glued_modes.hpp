#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

#include "fem/constraints.hpp"
#include "numerics/sparse_modes.hpp"

namespace dovetail::fem {

/// A joint glued in its contact, there perhaps through springs.
template <class Scalar>
struct GluedJoint {
  Constraints<Scalar> constraints;      ///< columns of the internal dofs, then of the contact dofs that are on springs
  Eigen::SparseMatrix<double> springs;  ///< [m, m] N/m, in the same coordinates
};

/// `flexibility`: of the springs [contact dofs], m/N, 0 where they are rigid; empty: all are.
template <class Scalar>
[[nodiscard]] GluedJoint<Scalar> glued_joint(const Constraints<Scalar>& constraints,
                                             const Eigen::VectorXd& flexibility) {
  const Eigen::Index internal = constraints.internal_count;
  std::vector<Eigen::Triplet<double>> springs;
  std::vector<Eigen::Triplet<Scalar>> kept;
  for (Eigen::Index i = 0; i < internal; ++i) kept.emplace_back(i, i, Scalar(1));
  for (Eigen::Index c = 0; c < flexibility.size(); ++c) {
    if (flexibility(c) == 0) continue;
    const Eigen::Index at = internal + static_cast<Eigen::Index>(springs.size());
    kept.emplace_back(internal + c, at, Scalar(1));
    springs.emplace_back(at, at, 1 / flexibility(c));
  }
  GluedJoint<Scalar> joint;
  joint.constraints.internal_count = internal;
  joint.constraints.contact_count = static_cast<Eigen::Index>(springs.size());
  const Eigen::Index size = joint.constraints.size();
  joint.springs.resize(size, size);
  joint.springs.setFromTriplets(springs.begin(), springs.end());
  if (springs.empty()) {
    joint.constraints.transformation = constraints.transformation.leftCols(internal);
    return joint;
  }
  Eigen::SparseMatrix<Scalar> selection(constraints.size(), size);
  selection.setFromTriplets(kept.begin(), kept.end());
  joint.constraints.transformation = constraints.transformation * selection;
  return joint;
}

/// Modes with the contact dofs at zero, or on springs of that flexibility (see glued_joint): the blade glued to the
/// disk. `stiffness` and `mass` are over all nodes (at speed: see stiffness_at_speed). Vectors are over the dofs of the
/// glued joint, mass-normalised.
template <class Scalar>
[[nodiscard]] numerics::Modes<Scalar> glued_modes(const Eigen::SparseMatrix<double>& stiffness,
                                                  const Eigen::SparseMatrix<double>& mass,
                                                  const Constraints<Scalar>& constraints,
                                                  const numerics::ModesOptions& options,
                                                  numerics::SparseCholesky<Scalar>& cholesky,
                                                  const Eigen::VectorXd& flexibility = {}) {
  const GluedJoint<Scalar> joint = glued_joint(constraints, flexibility);
  Eigen::SparseMatrix<Scalar> held = constrain(stiffness, joint.constraints);
  if (joint.springs.nonZeros() > 0) held += joint.springs.template cast<Scalar>();
  return numerics::smallest_modes<Scalar>(held, constrain(mass, joint.constraints), options, cholesky);
}

}  // namespace dovetail::fem
