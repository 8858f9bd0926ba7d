#pragma once

#include <optional>
#include <string>
#include <vector>

#include "response/error_bars.hpp"
#include "response/penalty_sensitivity.hpp"
#include "response/stability.hpp"
#include "response/traction_bounds.hpp"
#include "studies/program/engine.hpp"

namespace dovetail::studies {

/// Ranges over the admissible residual tractions of stuck nodes.
struct TractionRanges {
  std::vector<response::TractionBounds> amplitudes;  ///< of each output
  response::TractionBounds friction_energy;
  response::TractionBounds wear_rate;
};

/// What was asked for about one steady state besides itself; empty: not asked for, or the state did not converge.
struct PointAnalysis {
  std::optional<response::ErrorBars> bars;
  std::optional<response::PenaltySensitivity> sensitivity;
  std::optional<response::Stability> stability;
  std::optional<TractionRanges> tractions;
};

/// The analyses of `choice` for a state computed from `loaded`.
[[nodiscard]] PointAnalysis analyse(const LoadedModel& loaded, const response::SteadyState& state,
                                    const AnalysisChoice& choice);

/// "3 of 8 error bars are not known: 3 stalled; ..." for the analyses that did not converge; empty when all did.
[[nodiscard]] std::string analysis_failures(const std::vector<PointAnalysis>& analyses);

}  // namespace dovetail::studies
