#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "paths/steady_state.hpp"

namespace dovetail::paths {

/// Steady states at the frequencies `omega` (rad/s) in the order given, each started from the last one that converged
/// by the predictor dU = dU/dw dw (and from closed contact when that fails). A point that fails is approached over
/// frequencies in between, then another branch is looked for further on and followed back, before other
/// pseudo-penalties are tried; these states are not reported but counted in steady::State::intermediate. Every point
/// carries its own status, iterations and evaluations, those of its intermediate states included; states keep no
/// tangent unless `keep_tangents`. `progress` may return false to stop early: the points not computed then
/// carry Status::interrupted.
[[nodiscard]] std::vector<steady::State> frequency_response(
    const steady::Joint& joint, std::span<const double> omega,
    const std::function<bool(std::size_t point, const steady::State&)>& progress = {}, bool keep_tangents = false);

}  // namespace dovetail::paths
