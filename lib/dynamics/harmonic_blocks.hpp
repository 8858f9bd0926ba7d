#pragma once

#include <Eigen/Core>
#include <vector>

namespace dovetail::dynamics {

enum class Form { plain, transposed, conjugated, adjoint };

/// Applies one complex matrix A_h [p, q] per harmonic to real coefficients X [q (2H+1), m], whose rows are coefficient
/// by coefficient (mean, cos 1, sin 1, ...) and stand for the amplitudes c - i s: [p (2H+1), m], or with p and q
/// exchanged for transposed and adjoint forms. The transpose of this real operator is that of the adjoint form.
[[nodiscard]] Eigen::MatrixXd apply_harmonics(const std::vector<const Eigen::MatrixXcd*>& matrices, Form form,
                                              const Eigen::MatrixXd& x);

}  // namespace dovetail::dynamics
