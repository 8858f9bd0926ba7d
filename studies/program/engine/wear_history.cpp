#include "studies/program/engine/wear_history.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "paths/frequency_response.hpp"
#include "paths/resonance.hpp"
#include "paths/steady_state.hpp"
#include "studies/program/engine/number_constants.hpp"
#include "studies/program/engine/stored_history.hpp"
#include "studies/program/engine/wear_methods.hpp"
#include "studies/program/study_file/refusal.hpp"
#include "wear/asymptote/depth_scale.hpp"

namespace dovetail::studies {

namespace {

/// Steps that a history in hundredths of its depth may take before it counts as going nowhere.
constexpr int kSteps = 1000;

/// Frequencies of the curves, Hz.
std::vector<double> curve_frequencies(const WearOptions& options, const LoadedModel& loaded,
                                      const wear::History& history) {
  double low = options.curve_from_hz.value_or(0), high = options.curve_to_hz.value_or(0);
  if (!options.curve_from_hz) {
    const steady::Joint unworn = loaded.joint.worn(history.depth.row(0).transpose());
    const double start = history.frequency[0];
    const paths::Resonance first = paths::resonance(unworn, start);
    const paths::Resonance last =
        paths::resonance(loaded.joint.worn(history.final_depth), history.frequency[history.frequency.size() - 1]);
    const double from = first.status == Status::converged ? first.omega : start;
    const double to = last.status == Status::converged ? last.omega : from;
    const steady::State peak = paths::steady_state(unworn, from);
    constexpr double kFirst = 1e-5, kWidest = 0.1, kWidths = 3;
    double width = kFirst;
    while (width < kWidest) {
      const steady::State side = paths::steady_state(unworn, from * (1 - width), peak.displacement);
      if (side.status == Status::converged && side.amplitudes[0] < 0.5 * peak.amplitudes[0]) break;
      width *= 2;
    }
    low = std::min(from, to) * (1 - kWidths * width) / kTurn;
    high = std::max(from, to) * (1 + kWidths * width) / kTurn;
  }
  std::vector<double> hz;
  const int points = options.curve_points.value_or(60);
  for (int i = 0; i < points; ++i) hz.push_back(low + (high - low) * i / std::max(1, points - 1));
  return hz;
}

}  // namespace

ComputedHistory compute_history(const WearOptions& options, const LoadedModel& loaded, const WearStart& at,
                                const wear::Watcher& watcher) {
  constexpr double kShare = 0.01;
  ComputedHistory result;
  HistoryChoice& choice = result.choice;
  wear::HistoryOptions& settings = choice.options;
  if (options.integrator == wear::IntegratorKind::implicit_steps) settings = wear::HistoryOptions::implicit();
  settings.follow = follow_of(options.follow.value_or(Drive::fixed));
  settings.cycles = options.cycles.value_or(settings.cycles);
  settings.steps = options.steps.value_or(kSteps);
  settings.tolerance = options.history_tolerance.value_or(settings.tolerance);

  choice.identity = history_identity(options, loaded, at.hz);
  double omega = at.omega;
  const steady::Joint& joint = loaded.joint;
  std::optional<double> increment = options.increment_m;
  std::optional<StoredHistory> past;
  if (!options.resume.empty()) {
    choice.resumed_from = options.resume;
    past = read_history(options.resume, loaded.joint.model->nodes());
    check_identity(*past, choice.identity, options.resume);
    const double done = past->history.cycles[past->history.cycles.size() - 1];
    if (options.cycles && *options.cycles <= done)
      refuse("--cycles", "must be > " + shortest(done) + ", the cycles done in " + options.resume,
             shortest(*options.cycles));
    if (!options.history_tolerance && past->tolerance > 0) settings.tolerance = past->tolerance;
    choice.start_cycles = done;
    choice.depth_scale = past->depth_scale;
    // A joint at rest, or one that wears steadily for ever, stays so.
    if (past->history.end == wear::HistoryEnd::worn_out || past->history.end == wear::HistoryEnd::steady_rate) {
      settings.increment = increment.value_or(past->increment);
      result.history = past->history;
      return result;
    }
    omega = past->history.frequency[past->history.frequency.size() - 1];
    if (!increment && past->increment > 0) increment = past->increment;
  }
  int solves = 0;
  if (options.integrator == wear::IntegratorKind::explicit_jumps && !increment) {
    const steady::State* initial =
        at.resonance && joint.condition.wear_depth.size() == 0 && joint.condition.slip_origin.size() == 0
            ? &at.resonance->state
            : nullptr;
    const wear::DepthScale scale = wear::depth_scale(joint, omega, settings.rate_threshold, initial, watcher);
    solves = scale.solves;
    choice.depth_scale = scale.depth;
    if (scale.depth > 0) increment = kShare * scale.depth;
  }
  settings.increment = increment.value_or(settings.increment);
  result.history = wear::history(joint, {.omega = omega, .unworn = nullptr, .past = past ? &past->history : nullptr},
                                 settings, watcher);
  result.history.solves += solves + (past ? past->history.solves : 0);
  return result;
}

std::vector<WornCurve> worn_curves(const WearOptions& options, const LoadedModel& loaded, const wear::History& history,
                                   const wear::Watcher& watcher) {
  std::vector<WornCurve> curves;
  const Eigen::Index states = history.cycles.size();
  const int count = options.curves.value_or(0);
  if (count == 0 || states == 0 || watcher.stopped()) return curves;
  const std::vector<double> hz = curve_frequencies(options, loaded, history);
  std::vector<double> omega(hz.size());
  std::ranges::transform(hz, omega.begin(), [](double value) { return kTurn * value; });
  Eigen::Index before = -1;
  for (int k = 0; k < count && !watcher.stopped(); ++k) {
    const double share = count == 1 ? 1.0 : static_cast<double>(k) / (count - 1);
    const double volume = history.worn_volume[0] + share * (history.worn_volume[states - 1] - history.worn_volume[0]);
    Eigen::Index state = 0;
    (history.worn_volume.array() - volume).abs().minCoeff(&state);
    if (state <= before) continue;  // fewer states than curves
    before = state;
    WornCurve curve{.cycles = history.cycles[state], .worn_volume = history.worn_volume[state], .frequency_hz = hz};
    const steady::Joint worn = loaded.joint.worn(history.depth.row(state).transpose());
    const auto go_on = [&](std::size_t, const steady::State&) { return !watcher.stopped(); };
    for (const steady::State& found : paths::frequency_response(worn, omega, go_on))
      curve.amplitude.push_back(found.status == Status::converged ? found.amplitudes[0] : kUnknown);
    curves.push_back(std::move(curve));
  }
  return curves;
}

}  // namespace dovetail::studies
