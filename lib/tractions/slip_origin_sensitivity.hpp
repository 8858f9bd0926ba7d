#pragma once

#include <Eigen/Core>

#include "steady/state.hpp"

namespace dovetail::tractions {

/// Derivatives of responses with respect to the slip origins X_T [Nc, d-1] at which the marches start, through
/// f(U; X_T) = 0. A node that neither slipped nor separated in any marched period has lambda_T = lambda_u,T - eps X_T,
/// so df/dX_T = -eps in its mean row and nothing else. Any other node has forgotten X_T, or keeps a part of it (its
/// slip died out at the friction limit) that is left out: its entries are zero. One solve with J^T each. `state` keeps
/// its tangent.

/// d amplitude / d X_T of one output (half peak-to-peak), at constant frequency.
[[nodiscard]] Eigen::MatrixXd amplitude_to_slip_origin(const steady::State& state, Eigen::Index output);

/// d (sum_i weight_i int lambda_N |dX_T| of node i) / d X_T, weights [Nc]: mu for the friction energy (J per cycle and
/// m), k_w / area for depths.
[[nodiscard]] Eigen::MatrixXd slip_load_to_slip_origin(const steady::State& state, const Eigen::VectorXd& weights);

/// Predicted change of U [nc, 2H+1] for a change dX_T [Nc, d-1]; the same nodes count.
[[nodiscard]] Eigen::MatrixXd response_to_slip_origin(const steady::State& state, const Eigen::MatrixXd& change);

}  // namespace dovetail::tractions
