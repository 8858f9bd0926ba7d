#pragma once

#include <Eigen/Core>
#include <memory>

#include "paths/params.hpp"

namespace dovetail::paths {

/// The periodic response of a joint to its excitation at `omega` (rad/s, > 0). `guess` is U [nc, 2H+1] of a nearby
/// state or empty (start closed). Throws InputError on bad options or sizes; everything else is a status: singular when
/// the forces balance but the Jacobian is singular there, as for a body that nothing holds. `reuse`, the tangent of a
/// nearby state (another frequency, wear or contact condition), may spare factorisations on the way from `guess`.
[[nodiscard]] steady::State steady_state(const steady::Joint& joint, double omega, const Eigen::MatrixXd& guess = {},
                                         const std::shared_ptr<const steady::Tangent>& reuse = {},
                                         const WayParams& ways = {});

/// Coefficients [rows, 2H+1] cut or filled with zeros to [rows, 2 harmonics + 1].
[[nodiscard]] Eigen::MatrixXd padded(const Eigen::MatrixXd& coefficients, int harmonics);

/// The steady state at the frequency of `state` with other harmonics, samples or pseudo-penalty than those it was
/// computed with, started from it. `finer` has the options of the new state; its pseudo-penalty is multiplied by the
/// ratio the cascade left `state` at, no other is tried and no neighbouring problem: an answer with another eps would
/// not measure what was asked. `reuse`: see steady_state. Without `linearise` the regularity of the Jacobian is
/// trusted, since that of `state` was shown. `penalty_ratio` of the result is relative to `finer`, as that of `state`
/// is to its options.
[[nodiscard]] steady::State refined_state(steady::Joint finer, const steady::State& state,
                                          const std::shared_ptr<const steady::Tangent>& reuse = {});

}  // namespace dovetail::paths
