#pragma once

#include <optional>
#include <string>
#include <vector>

#include "quality/error_bars.hpp"
#include "quality/penalty_sensitivity.hpp"
#include "stability/stability.hpp"
#include "studies/program/engine/loaded_model.hpp"
#include "studies/program/questions/analysis_choice.hpp"
#include "tractions/traction_bounds.hpp"

namespace dovetail::studies {

/// Ranges over the admissible residual tractions of stuck nodes.
struct TractionRanges {
  std::vector<tractions::TractionBounds> amplitudes;  ///< of each output
  tractions::TractionBounds friction_energy;
  tractions::TractionBounds wear_rate;
};

/// What was asked for about one steady state besides itself; empty: not asked for, or the state did not converge.
struct PointAnalysis {
  std::optional<quality::ErrorBars> bars;
  std::optional<quality::PenaltySensitivity> sensitivity;
  std::optional<stability::Stability> stability;
  std::optional<TractionRanges> tractions;
};

/// The analyses of `choice` for a state computed from `loaded`.
[[nodiscard]] PointAnalysis analyse(const LoadedModel& loaded, const steady::State& state,
                                    const AnalysisChoice& choice);

/// "3 of 8 error bars are not known: 3 stalled; ..." for the analyses that did not converge; empty when all did.
[[nodiscard]] std::string analysis_failures(const std::vector<PointAnalysis>& analyses);

}  // namespace dovetail::studies
