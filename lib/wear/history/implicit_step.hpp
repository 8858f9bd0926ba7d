#pragma once

#include <Eigen/Core>

#include "wear/history/implicit_stage.hpp"

namespace dovetail::wear {

/// A step of `jump` cycles of dW/dn = r from `point` by the L-stable, stiffly accurate scheme of two stages and second
/// order, gamma = 1 - 1/sqrt(2) [Alexander 1977]: W_1 = W + gamma dn r_1, W_2 = W + (1 - gamma) dn r_1 + gamma dn r_2.
/// Writes the end of it and, in `error` [Nc] m, the local error when it converges: the difference from the third-order
/// quadrature over r, r_1 and r_2, damped as the equations damp it [Hosea & Shampine 1996]. At most `iterations`
/// Jacobians per stage.
[[nodiscard]] Status implicit_step(ImplicitStage& stage, double jump, int iterations, WearPoint& point,
                                   Eigen::VectorXd& error);

}  // namespace dovetail::wear
