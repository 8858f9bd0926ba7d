#include "studies/program/engine/point_analysis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "paths/steady_state.hpp"

namespace dovetail::studies {
namespace {

/// The same state with its tangent, which the points of a curve do not keep: solved again from itself, without a step.
steady::State linearised(const LoadedModel& loaded, const steady::State& state) {
  if (state.tangent) return state;
  steady::Options options = loaded.joint.options;
  options.linearise = true;
  options.penalty_scale *= state.penalty_ratio;
  return paths::steady_state({loaded.joint.model, {}, options}, state.omega, state.displacement);
}

TractionRanges traction_ranges(const LoadedModel& loaded, const steady::State& state) {
  using tractions::BoundedQuantity;
  const auto range = [&](BoundedQuantity quantity, int output) {
    return tractions::traction_bounds(loaded.joint, state.omega, quantity, {.output = output}, state.displacement);
  };
  TractionRanges ranges;
  for (std::size_t i = 0; i < loaded.model.output_names.size(); ++i)
    ranges.amplitudes.push_back(range(BoundedQuantity::amplitude, static_cast<int>(i)));
  ranges.friction_energy = range(BoundedQuantity::friction_energy, 0);
  ranges.wear_rate = range(BoundedQuantity::wear_rate, 0);
  return ranges;
}

/// Status of one kind of analysis at a point, or nothing when it was not made there.
using StatusOf = std::optional<Status> (*)(const PointAnalysis&);

std::optional<Status> of_bars(const PointAnalysis& at) {
  return at.bars ? std::optional(at.bars->status) : std::nullopt;
}

std::optional<Status> of_sensitivity(const PointAnalysis& at) {
  return at.sensitivity ? std::optional(at.sensitivity->status) : std::nullopt;
}

std::optional<Status> of_tractions(const PointAnalysis& at) {
  if (!at.tractions) return std::nullopt;
  std::vector<Status> all{at.tractions->friction_energy.status, at.tractions->wear_rate.status};
  for (const tractions::TractionBounds& bounds : at.tractions->amplitudes) all.push_back(bounds.status);
  const auto failed = std::ranges::find_if(all, [](Status status) { return status != Status::converged; });
  return failed == all.end() ? Status::converged : *failed;
}

void describe_failures(const std::vector<PointAnalysis>& analyses, const char* what, StatusOf status_of,
                       std::string& text) {
  std::map<std::string_view, int> counts;
  int made = 0, failed = 0;
  for (const PointAnalysis& at : analyses) {
    const std::optional<Status> status = status_of(at);
    if (!status) continue;
    ++made;
    if (*status == Status::converged) continue;
    ++failed;
    ++counts[to_string(*status)];
  }
  if (failed == 0) return;
  text += fmt::format("{}{} of {} {} did not converge:", text.empty() ? "" : "; ", failed, made, what);
  for (const auto& [status, count] : counts) text += fmt::format(" {} {}", count, status);
}

}  // namespace

PointAnalysis analyse(const LoadedModel& loaded, const steady::State& state, const AnalysisChoice& choice) {
  PointAnalysis result;
  if (state.status != Status::converged) return result;
  if (choice.error_bars) result.bars = quality::error_bars(loaded.joint, state);
  if (choice.penalty_sensitivity) result.sensitivity = quality::penalty_sensitivity(loaded.joint, state);
  if (choice.stability) result.stability = stability::local_stability(loaded.model, linearised(loaded, state));
  if (choice.traction_bounds) result.tractions = traction_ranges(loaded, state);
  return result;
}

std::string analysis_failures(const std::vector<PointAnalysis>& analyses) {
  std::string text;
  describe_failures(analyses, "error bars", of_bars, text);
  describe_failures(analyses, "pseudo-penalty sensitivities", of_sensitivity, text);
  describe_failures(analyses, "searches over residual tractions", of_tractions, text);
  return text;
}

}  // namespace dovetail::studies
