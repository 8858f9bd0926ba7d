#pragma once

#include <Eigen/Core>
#include <vector>

namespace dovetail::dynamics {

enum class Form { plain, transposed, conjugated, adjoint };

/// Amplitudes c - i s (conjugated: c + i s) of harmonic h of coefficients X [n (2H+1), m], whose rows are coefficient
/// by coefficient (mean, cos 1, sin 1, ...): [n, m].
[[nodiscard]] Eigen::MatrixXcd amplitude(const Eigen::MatrixXd& x, Eigen::Index n, Eigen::Index h, bool conjugated);
/// Writes amplitudes of harmonic h as such coefficients. That of the mean is real.
void put_amplitude(const Eigen::MatrixXcd& amplitude, Eigen::Index h, bool conjugated, Eigen::MatrixXd& x);

/// Applies one complex matrix A_h [p, q] per harmonic to the amplitudes c - i s of real coefficients
/// X [q (2H+1), m]: [p (2H+1), m], or with p and q exchanged for transposed and adjoint forms. The transpose of this
/// real operator is that of the adjoint form.
[[nodiscard]] Eigen::MatrixXd apply_harmonics(const std::vector<const Eigen::MatrixXcd*>& matrices, Form form,
                                              const Eigen::MatrixXd& x);

}  // namespace dovetail::dynamics
