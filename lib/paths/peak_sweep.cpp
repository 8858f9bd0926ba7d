#include "paths/peak_sweep.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "paths/amplitude.hpp"
#include "paths/continuation.hpp"
#include "paths/params.hpp"
#include "paths/peak_search.hpp"

namespace dovetail::paths {
namespace {

// Of a point that was not computed none.
double height_of(const branches::BranchPoint& at, Eigen::Index output) {
  return at.state.amplitudes.size() > output ? at.state.amplitudes(output) : 0;
}

// Points of the branch that are higher than both neighbours, highest first.
std::vector<std::size_t> summits(const branches::Branch& branch, Eigen::Index output) {
  std::vector<std::size_t> found;
  const auto height = [&](std::size_t i) { return height_of(branch.points[i], output); };
  for (std::size_t i = 1; i + 1 < branch.points.size(); ++i)
    if (height(i) > height(i - 1) && height(i) >= height(i + 1)) found.push_back(i);
  std::sort(found.begin(), found.end(), [&](std::size_t a, std::size_t b) { return height(a) > height(b); });
  return found;
}

constexpr PeakSweepParams kPeakSweep;

/// The maximum beside point `i` of the branch, which is higher than its neighbours. `joint` linearises. Counts its work
/// in `work`.
std::optional<steady::State> maximum_beside(const branches::Branch& branch, std::size_t i, const steady::Joint& joint,
                                            const ResonanceOptions& options, Resonance& work) {
  // The width of the peak needs a tangent. The points of the sweep keep none, nor what one is made of: few of them are
  // summits.
  const steady::State summit = refined_state(joint, branch.points[i].state);
  ++work.solves;
  work.jacobians += summit.iterations;
  if (summit.status != Status::converged) return {};
  const AmplitudeSlope at = amplitude_slope(summit, options.output);
  const branches::Equations equations(joint, branch.penalty_ratio);
  if (std::optional<steady::State> top = climb(equations, summit, at.width, options, work)) return top;
  const auto away = [&](std::size_t j) { return std::abs(branch.points[j].state.omega / summit.omega - 1); };
  ResonanceOptions between = options;
  between.search_range = std::max(away(i - 1), away(i + 1));
  Resonance found = search_peak(joint, summit.omega, between, summit.displacement);
  work.solves += found.solves;
  work.jacobians += found.jacobians;
  if (found.status != Status::converged || found.amplitude < ClimbParams{}.height * at.amplitude) return {};
  return std::move(found.state);
}

Resonance swept(const steady::Joint& joint, double omega_from, double omega_to,
                const ResonanceOptions& resonance_options) {
  branches::FollowOptions coarse = kPeakSweep.steps;
  coarse.max_jacobians = resonance_options.max_sweep_jacobians;
  steady::Joint without = joint, with = joint;
  without.options.linearise = false;
  with.options.linearise = true;
  const branches::Branch branch = continuation(without, omega_from, omega_to, coarse);
  Resonance result{.status = branch.status, .state = {}};
  result.solves = static_cast<int>(branch.points.size()) + branch.rejected;
  result.jacobians = branch.jacobians;
  const std::vector<std::size_t> candidates = summits(branch, resonance_options.output);
  if (branch.status == Status::converged) result.status = Status::no_bracket;
  if (!branch.points.empty()) {
    const auto height = [&](const branches::BranchPoint& at) { return height_of(at, resonance_options.output); };
    result.ends = std::max(height(branch.points.front()), height(branch.points.back()));
  }
  for (std::size_t c = 0; c < std::min(candidates.size(), kPeakSweep.tried); ++c) {
    const double height = branch.points[candidates[c]].state.amplitudes(resonance_options.output);
    if (height < kPeakSweep.hopeless * result.amplitude) break;
    std::optional<steady::State> state = maximum_beside(branch, candidates[c], with, resonance_options, result);
    if (!state) {
      result.unresolved = std::max(result.unresolved, height);
      continue;
    }
    const AmplitudeSlope at = amplitude_slope(*state, resonance_options.output);
    if (at.amplitude <= result.amplitude) continue;
    result.status = Status::converged;
    result.omega = state->omega;
    result.amplitude = at.amplitude;
    result.slope = at.slope;
    result.state = std::move(*state);
  }
  if (result.unresolved <= (1 + noise_of_peaks(joint.options)) * result.amplitude) result.unresolved = 0;
  return result;
}

}  // namespace

Resonance peak_sweep(const steady::Joint& joint, double low, double high, const ResonanceOptions& resonance_options) {
  Resonance down = swept(joint, high, low, resonance_options);
  if ((down.status == Status::converged && down.unresolved == 0) || cut_short(down.status)) return down;
  Resonance up = swept(joint, low, high, resonance_options);
  const bool better = up.status == Status::converged && (down.status != Status::converged || up.unresolved == 0);
  Resonance& found = better ? up : down;
  const Resonance& other = better ? down : up;
  found.solves += other.solves;
  found.jacobians += other.jacobians;
  return std::move(found);
}

}  // namespace dovetail::paths
