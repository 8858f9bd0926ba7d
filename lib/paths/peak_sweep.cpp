#include "paths/peak_sweep.hpp"

#include <algorithm>

#include "paths/continuation.hpp"
#include "paths/params.hpp"
#include "paths/peak.hpp"

namespace dovetail::paths {
namespace {

// Points of the branch that are higher than both neighbours, highest first.
std::vector<std::size_t> summits(const branches::Branch& branch, Eigen::Index output) {
  std::vector<std::size_t> found;
  const auto height = [&](std::size_t i) { return branch.points[i].state.amplitudes(output); };
  for (std::size_t i = 1; i + 1 < branch.points.size(); ++i)
    if (height(i) > height(i - 1) && height(i) >= height(i + 1)) found.push_back(i);
  std::sort(found.begin(), found.end(), [&](std::size_t a, std::size_t b) { return height(a) > height(b); });
  return found;
}

constexpr PeakSweepParams kPeakSweep;

}  // namespace

std::optional<steady::State> climb(const branches::Equations& equations, const steady::State& from, double width,
                                   const ResonanceOptions& options, Resonance& work) {
  const branches::ArcMetric metric = peak_metric(from, width);
  branches::Vector start{.displacement = from.displacement, .parameter = from.omega};
  double height = from.amplitudes(options.output);
  Peak peak;
  // Where the branch turns away from where it led at the start, the climb begins anew.
  for (int i = 0; i < kPeakSweep.climbs; ++i) {
    peak = find_peak(equations, start, metric,
                     {.output = options.output, .frequency_tolerance = options.frequency_tolerance});
    ++work.solves;
    work.jacobians += peak.iterations;
    const bool ended = peak.status != Status::stalled && peak.status != Status::iteration_limit;
    if (ended || peak.amplitude < (1 + kPeakSweep.gain) * height) break;
    height = peak.amplitude;
    start = peak.at;
  }
  if (peak.status != Status::converged || peak.amplitude < kPeakSweep.height * from.amplitudes(options.output))
    return {};
  steady::State state = described(equations, peak, metric);
  if (state.status != Status::converged || !state.tangent) return {};
  return state;
}

Resonance peak_sweep(const steady::Joint& joint, double omega_from, double omega_to,
                     const ResonanceOptions& resonance_options) {
  branches::FollowOptions coarse = kPeakSweep.steps;
  coarse.max_jacobians = resonance_options.max_sweep_jacobians;
  steady::Joint without = joint, with = joint;
  without.options.linearise = false;
  with.options.linearise = true;
  branches::Branch branch = continuation(without, omega_from, omega_to, coarse);
  Resonance result{.status = branch.status, .state = {}};
  result.solves = static_cast<int>(branch.points.size()) + branch.rejected;
  result.jacobians = branch.jacobians;
  const std::vector<std::size_t> candidates = summits(branch, resonance_options.output);
  if (branch.status == Status::converged) result.status = Status::no_bracket;
  const branches::Equations equations(with, branch.penalty_ratio);
  for (std::size_t c = 0; c < std::min(candidates.size(), kPeakSweep.tried); ++c) {
    const steady::State& summit = branch.points[candidates[c]].state;
    if (summit.amplitudes(resonance_options.output) < kPeakSweep.hopeless * result.amplitude) break;
    // The points of the sweep have no tangents, which the width of the peak needs.
    const steady::State from = refined_state(with, summit);
    ++result.solves;
    result.jacobians += from.iterations;
    if (from.status != Status::converged) continue;
    std::optional<steady::State> state =
        climb(equations, from, amplitude_slope(from, resonance_options.output).width, resonance_options, result);
    if (!state) continue;
    const AmplitudeSlope at = amplitude_slope(*state, resonance_options.output);
    if (at.amplitude <= result.amplitude) continue;
    result.status = Status::converged;
    result.omega = state->omega;
    result.amplitude = at.amplitude;
    result.slope = at.slope;
    result.state = std::move(*state);
  }
  return result;
}

}  // namespace dovetail::paths
