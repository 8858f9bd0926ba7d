#include "paths/peak_sweep.hpp"

#include <algorithm>

#include "paths/continuation.hpp"
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

// The frequency range in which the output changes by its own size, from the neighbours of a summit.
double width_at(const branches::Branch& branch, std::size_t i, Eigen::Index output) {
  const steady::State &before = branch.points[i - 1].state, &after = branch.points[i + 1].state;
  const double change = (after.outputs.row(output) - before.outputs.row(output)).norm();
  const double range = std::abs(after.omega - before.omega);
  const double omega = branch.points[i].state.omega, size = branch.points[i].state.amplitudes(output);
  constexpr double kSharpest = 1e-6, kWidest = 0.5;
  return omega * std::clamp(change > 0 ? range * size / (change * omega) : kWidest, kSharpest, kWidest);
}

constexpr double kHeight = 0.99;  // of the summit: a search may have run off to a lower maximum

}  // namespace

std::optional<steady::State> climb(const branches::Equations& equations, const steady::State& from, double width,
                                   const ResonanceOptions& options, Resonance& work) {
  const branches::ArcMetric metric = peak_metric(from, width);
  branches::Vector start{.displacement = from.displacement, .parameter = from.omega};
  double height = from.amplitudes(options.output);
  Peak peak;
  // Where the branch turns away from where it led at the start, the climb begins anew.
  constexpr int kClimbs = 8;
  constexpr double kGain = 1e-3;
  for (int i = 0; i < kClimbs; ++i) {
    peak = find_peak(equations, start, metric,
                     {.output = options.output, .frequency_tolerance = options.frequency_tolerance});
    ++work.solves;
    work.jacobians += peak.iterations;
    const bool ended = peak.status != Status::stalled && peak.status != Status::iteration_limit;
    if (ended || peak.amplitude < (1 + kGain) * height) break;
    height = peak.amplitude;
    start = peak.at;
  }
  if (peak.status != Status::converged || peak.amplitude < kHeight * from.amplitudes(options.output)) return {};
  steady::State state = described(equations, peak, metric);
  if (state.status != Status::converged || !state.tangent) return {};
  return state;
}

Resonance peak_sweep(const steady::Joint& joint, double omega_from, double omega_to,
                     const ResonanceOptions& resonance_options) {
  // Coarse steps: what counts is that no peak is stepped over, and the change of the outputs sees to that.
  const branches::FollowOptions coarse{.largest_parameter_step = 0.02,
                                       .largest_change = 0.5,
                                       .largest_turn = 0.8,
                                       .max_points = 1000,
                                       .max_jacobians = resonance_options.max_sweep_jacobians,
                                       .locate_turns = false};
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
  // A summit of coarse steps may be lower than the peak beside it is high: the first few are all climbed.
  constexpr std::size_t kTried = 3;
  constexpr double kHopeless = 0.8;
  for (std::size_t c = 0; c < std::min(candidates.size(), kTried); ++c) {
    const steady::State& summit = branch.points[candidates[c]].state;
    if (summit.amplitudes(resonance_options.output) < kHopeless * result.amplitude) break;
    const double width = width_at(branch, candidates[c], resonance_options.output);
    std::optional<steady::State> state = climb(equations, summit, width, resonance_options, result);
    if (!state) {
      ResonanceOptions near = resonance_options;
      near.sweep_range = 0;
      Resonance stepped = resonance(with, summit.omega, near, summit.displacement);
      result.solves += stepped.solves;
      result.jacobians += stepped.jacobians;
      if (stepped.status == Status::converged &&
          stepped.amplitude >= kHeight * summit.amplitudes(resonance_options.output))
        state = std::move(stepped.state);
    }
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
