#include "studies/program/point_analysis.hpp"

#include <utility>

namespace dovetail::studies {
namespace {

/// The same state with its linearisation: solved again from itself, which takes no iteration.
response::SteadyState linearised(const LoadedModel& loaded, const response::SteadyState& state) {
  if (state.linearisation) return state;
  response::SteadyOptions options = loaded.steady;
  options.linearise = true;
  options.penalty_scale *= state.penalty_ratio;
  return response::steady_state(loaded.condensed, state.omega, {}, options, state.displacement);
}

}  // namespace

PointAnalysis analyse(const LoadedModel& loaded, const response::SteadyState& state, const AnalysisChoice& choice) {
  PointAnalysis result;
  if (state.status != Status::converged) return result;
  if (choice.error_bars) result.bars = response::error_bars(loaded.condensed, state, {}, loaded.steady);
  if (choice.penalty_sensitivity)
    result.sensitivity = response::penalty_sensitivity(loaded.condensed, state, {}, loaded.steady);
  if (choice.stability) result.stability = response::local_stability(loaded.model, linearised(loaded, state));
  return result;
}

}  // namespace dovetail::studies
