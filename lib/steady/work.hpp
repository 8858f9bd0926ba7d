#pragma once

#include <Eigen/Core>

namespace dovetail::steady {

/// What computations cost, in operations of dense linear algebra: measured times over that of one operation inside a
/// large factorisation. They say how a Budget is shared out and need to be right within a factor of two.

/// A dense factorisation of n unknowns, 2/3 n^3.
[[nodiscard]] double factorisation_operations(Eigen::Index unknowns);

/// `open` of so many contact dofs condensed in H+1 harmonics.
[[nodiscard]] double condensation_operations(Eigen::Index open, Eigen::Index dofs, int harmonics);

/// The same where the harmonics share what is static, with so many coordinates within.
[[nodiscard]] double shared_condensation_operations(Eigen::Index open, Eigen::Index kept, Eigen::Index within,
                                                    int harmonics);

/// Products with matrices of so many entries together, which are read once for each.
[[nodiscard]] double product_operations(double entries);

/// One contact node marched over `periods` of `samples`, and the derivative with respect to its m = d (2H+1)
/// `coefficients`.
[[nodiscard]] double march_operations(int samples, int periods);
[[nodiscard]] double derivative_operations(int samples, int periods, Eigen::Index coefficients);

/// One Jacobian in which every node takes part: each marched for one period with derivative, and the factorisation.
[[nodiscard]] double jacobian_operations(Eigen::Index nodes, Eigen::Index directions, int harmonics, int samples);

}  // namespace dovetail::steady
