#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "response/steady_state.hpp"

namespace dovetail::response {

/// Steady states at the frequencies `omega` (rad/s) in the order given, each started from the last one that converged
/// by the predictor dU = dU/dw dw (and from closed contact when that fails). A point that fails is approached over
/// frequencies in between, then another branch is looked for further on and followed back, before other
/// pseudo-penalties are tried; these states are not reported but counted in SteadyState::intermediate. Every point
/// carries its own status, iterations and evaluations, those of its intermediate states included; states keep no
/// linearisation unless `keep_linearisations`. `progress` may return false to stop early: the points not computed then
/// carry Status::interrupted.
[[nodiscard]] std::vector<SteadyState> frequency_response(
    const std::shared_ptr<const CondensedModel>& model, std::span<const double> omega,
    const ContactCondition& condition, const SteadyOptions& options,
    const std::function<bool(std::size_t point, const SteadyState&)>& progress = {}, bool keep_linearisations = false);

}  // namespace dovetail::response
