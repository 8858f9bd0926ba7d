#pragma once

#include "response/steady_state.hpp"

namespace dovetail::response {

/// Fills everything of `steady` that follows from a point of the residual: forces, node summaries, wear, outputs,
/// energies, error estimates.
void summarise(const SteadyResidual& residual, const ResidualState& state, SteadyState& steady);

}  // namespace dovetail::response
