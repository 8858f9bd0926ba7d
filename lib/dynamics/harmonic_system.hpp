#pragma once

#include <Eigen/Core>
#include <vector>

#include "dynamics/condensed_model.hpp"

namespace dovetail::dynamics {

/// All harmonics of the dynamic stiffness at one frequency.
struct HarmonicSystem {
  double omega = 0;                          ///< rad/s
  HarmonicMatrices stiffness;                ///< Z_h
  std::vector<CondensedHarmonic> harmonics;  ///< [H+1]
  Eigen::MatrixXd force;                     ///< F [nc, 2H+1], N
  double force_scale = 0;  ///< norm of F over harmonics >= 1, or of F_0 when that is zero: residuals are relative to it
  bool of_model = true;    ///< of the model alone, with nothing added to it
  Status status = Status::converged;
};

/// Assembles harmonics 0..H at omega (rad/s, > 0 unless H = 0).
[[nodiscard]] HarmonicSystem harmonic_system(const CondensedModel& model, int harmonics, double omega,
                                             double static_scale = 1);
/// Z U for U [nc, 2H+1], harmonic by harmonic; and dZ/dw U - dF/dw.
[[nodiscard]] Eigen::MatrixXd apply_stiffness(const HarmonicSystem& system, const Eigen::MatrixXd& displacement);
[[nodiscard]] Eigen::MatrixXd apply_slope(const CondensedModel& model, const HarmonicSystem& system,
                                          const Eigen::MatrixXd& displacement);

}  // namespace dovetail::dynamics
