#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "reduction/massless_boundary.hpp"

namespace dovetail::reduction {

/// Relative errors (Frobenius norm) of the undamped condensed dynamic stiffness
/// Z(w) = D_rr - D_ri D_ii^-1 D_ir, D = K - w^2 M, and of its inverse, at one angular frequency.
struct StiffnessError {
  double angular_frequency = 0;  ///< rad/s
  double stiffness = 0;          ///< |Z_red - Z| / |Z|
  double flexibility = 0;        ///< |Z_red^-1 - Z^-1| / |Z^-1|
};

/// Z of a reduced model whose contact dofs come first, without damping, [nc, nc] N/m.
Eigen::MatrixXd condensed_stiffness(const ReducedModel& model, double angular_frequency);

/// Z of the full model without damping, by one sparse LDL^T of D_ii. Undamped on both sides because the modal damping
/// of the reduced model has no sparse counterpart in the full one; at a glued resonance Z, at a free one Z^-1, is
/// unbounded, so choose frequencies away from them. Empty when D_ii is singular.
Eigen::MatrixXd condensed_stiffness(const FullModel& model, double angular_frequency);

/// Compares with the full model: one factorisation and nc back-solves per frequency.
std::vector<StiffnessError> compare(const FullModel& full, const Reduction& reduction,
                                    std::span<const double> angular_frequencies);

}  // namespace dovetail::reduction
