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

TractionRanges traction_ranges(const LoadedModel& loaded, const response::SteadyState& state) {
  using response::BoundedQuantity;
  const auto range = [&](BoundedQuantity quantity, int output) {
    return response::traction_bounds(loaded.condensed, state.omega, {}, loaded.steady, quantity, {.output = output},
                                     state.displacement);
  };
  TractionRanges ranges;
  for (std::size_t i = 0; i < loaded.model.output_names.size(); ++i)
    ranges.amplitudes.push_back(range(BoundedQuantity::amplitude, static_cast<int>(i)));
  ranges.friction_energy = range(BoundedQuantity::friction_energy, 0);
  ranges.wear_rate = range(BoundedQuantity::wear_rate, 0);
  return ranges;
}

}  // namespace

PointAnalysis analyse(const LoadedModel& loaded, const response::SteadyState& state, const AnalysisChoice& choice) {
  PointAnalysis result;
  if (state.status != Status::converged) return result;
  if (choice.error_bars) result.bars = response::error_bars(loaded.condensed, state, {}, loaded.steady);
  if (choice.penalty_sensitivity)
    result.sensitivity = response::penalty_sensitivity(loaded.condensed, state, {}, loaded.steady);
  if (choice.stability) result.stability = response::local_stability(loaded.model, linearised(loaded, state));
  if (choice.traction_bounds) result.tractions = traction_ranges(loaded, state);
  return result;
}

}  // namespace dovetail::studies
