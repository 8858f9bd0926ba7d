#include "quality/automatic.hpp"

#include <algorithm>
#include <array>

#include "paths/frequency_response.hpp"
#include "paths/steady_state.hpp"
#include "quality/params.hpp"
#include "quality/truncation.hpp"

namespace dovetail {
template <>
std::span<const Field<quality::AutomaticOptions>> option_table<quality::AutomaticOptions>() {
  using O = quality::AutomaticOptions;
  static const std::vector<Field<O>> fields{
      {.key = "harmonics", .member = &O::harmonics},
      {.key = "samples", .member = &O::samples},
      {.key = "amplitude_tolerance", .member = &O::amplitude_tolerance, .range = kPositive},
      {.key = "energy_tolerance", .member = &O::energy_tolerance, .range = kPositive},
      {.key = "max_harmonics", .member = &O::max_harmonics, .range = {.lower = 1}},
      {.key = "max_samples", .member = &O::max_samples, .range = {.lower = 3}},
  };
  return fields;
}
}  // namespace dovetail

namespace dovetail::quality {
namespace {

// The largest ratio of the bars to what is allowed; 1 is just within.
double excess(const Quantities& bars, const Quantities& value, double input_energy, const AutomaticOptions& automatic) {
  double result = 0;
  const auto add = [&](double bar, double allowed) {
    if (bar > 0) result = std::max(result, allowed > 0 ? bar / allowed : kInfinity);
  };
  const double largest = value.amplitudes.size() > 0 ? value.amplitudes.maxCoeff() : 0;
  for (Eigen::Index i = 0; i < value.amplitudes.size(); ++i)
    add(bars.amplitudes(i),
        automatic.amplitude_tolerance * std::max(value.amplitudes(i), AutomaticParams{}.floor * largest));
  add(bars.friction_energy,
      automatic.energy_tolerance *
          std::max(value.friction_energy, AutomaticParams{}.energy_floor * std::abs(input_energy)));
  return result;
}

steady::Options starting_options(const dynamics::CondensedModel& model, steady::Options options,
                                 const AutomaticOptions& automatic) {
  std::vector<Violation> found = violations(automatic);
  if (!found.empty()) throw InputError(std::move(found));
  constexpr AutomaticParams kStart;
  if (automatic.harmonics)
    options.harmonics = std::min(std::max(kStart.harmonics, model.force_harmonics()), automatic.max_harmonics);
  if (automatic.samples) {
    options.samples = std::min(kStart.samples, automatic.max_samples);
    while (options.samples < kStart.samples_per_harmonic * options.harmonics &&
           2 * options.samples <= automatic.max_samples)
      options.samples *= 2;
    if (!automatic.harmonics) options.samples = std::max(options.samples, 2 * options.harmonics + 1);
  }
  if (automatic.harmonics) options.harmonics = std::max(1, std::min(options.harmonics, (options.samples - 1) / 2));
  steady::validate(options);
  return options;
}

bool may_raise_harmonics(const steady::Options& options, const AutomaticOptions& automatic) {
  const steady::Options next = more_harmonics(options);
  return automatic.harmonics && next.harmonics <= automatic.max_harmonics &&
         (next.samples == options.samples || (automatic.samples && next.samples <= automatic.max_samples));
}

bool may_raise_samples(const steady::Options& options, const AutomaticOptions& automatic) {
  return automatic.samples && more_samples(options).samples <= automatic.max_samples;
}

// Refines from `start` until the bars are within tolerance.
AutomaticState chosen_from(const steady::Joint& joint, double omega, const AutomaticOptions& automatic,
                           const Eigen::MatrixXd& guess) {
  AutomaticState result;
  result.options = joint.options;
  const auto solve = [&](const Eigen::MatrixXd& from) {
    result.state = paths::steady_state(joint.with(result.options), omega, from);
    ++result.solves;
    result.jacobians += result.state.iterations;
  };
  solve(guess.size() > 0 ? paths::padded(guess, joint.options.harmonics) : guess);
  while (result.state.status != Status::converged && may_raise_harmonics(result.options, automatic)) {
    result.options = more_harmonics(result.options);
    solve({});
  }
  result.status = result.state.status;
  if (result.status != Status::converged) {
    result.bars = error_bars(joint.with(result.options), result.state);
    return result;
  }
  while (true) {
    const steady::Joint at = joint.with(result.options);
    Refinements refined = refine(at, result.state);
    result.solves += 4;
    result.jacobians += refined.jacobians;
    result.bars = bars_from(at, result.state, refined);
    const double input = result.state.input_energy;
    const Quantities& value = result.bars.value;
    if (excess(result.bars.total, value, input, automatic) <= 1) break;
    const Quantities series =
        combine(result.bars.harmonics, result.bars.penalty, [](double a, double b) { return a + b; });
    const double of_harmonics = excess(series, value, input, automatic);
    const double of_samples = excess(result.bars.samples, value, input, automatic);
    // What is below half its tolerance is not worth refining for the sake of something that cannot be refined.
    const bool harmonics = may_raise_harmonics(result.options, automatic) && of_harmonics > AutomaticParams{}.share;
    const bool samples = may_raise_samples(result.options, automatic) && of_samples > AutomaticParams{}.share;
    if (!harmonics && !samples) {
      result.status = result.bars.status != Status::converged ? result.bars.status : Status::iteration_limit;
      break;
    }
    const bool raise_harmonics = harmonics && (!samples || of_harmonics >= of_samples);
    steady::State& next = raise_harmonics ? refined.harmonics : refined.samples;
    if (next.status != Status::converged) {
      result.status = next.status;
      break;
    }
    result.options = raise_harmonics ? more_harmonics(result.options) : more_samples(result.options);
    result.state = std::move(next);
  }
  // The refined states the result came from were solved without their tangent.
  if (joint.options.linearise && !result.state.tangent) solve(result.state.displacement);
  return result;
}

// Indices of the points that show the most of something, each once.
std::vector<std::size_t> demanding_points(const std::vector<steady::State>& curve) {
  std::vector<std::size_t> points;
  const auto add_largest = [&](const auto& measure) {
    std::size_t best = curve.size();
    for (std::size_t i = 0; i < curve.size(); ++i)
      if (curve[i].status == Status::converged && (best == curve.size() || measure(curve[i]) > measure(curve[best])))
        best = i;
    if (best < curve.size() && std::ranges::find(points, best) == points.end()) points.push_back(best);
  };
  Eigen::Index outputs = 0;
  for (const steady::State& state : curve) outputs = std::max(outputs, state.amplitudes.size());
  for (Eigen::Index output = 0; output < outputs; ++output)
    add_largest([output](const steady::State& state) { return state.amplitudes(output); });
  add_largest([](const steady::State& state) { return state.friction_energy; });
  add_largest([](const steady::State& state) { return state.error_force; });
  add_largest([](const steady::State& state) {
    return state.friction_energy > AutomaticParams{}.energy_floor * std::abs(state.input_energy) ? state.error_energy
                                                                                                 : 0.0;
  });
  return points;
}

}  // namespace

bool within(const ErrorBars& bars, const steady::State& state, const AutomaticOptions& automatic) {
  return bars.status == Status::converged && excess(bars.total, bars.value, state.input_energy, automatic) <= 1;
}

AutomaticState automatic_state(const steady::Joint& joint, double omega, const AutomaticOptions& automatic,
                               const Eigen::MatrixXd& guess) {
  return chosen_from(joint.with(starting_options(*joint.model, joint.options, automatic)), omega, automatic, guess);
}

AutomaticSettings automatic_settings(const steady::Joint& joint, std::span<const double> omega,
                                     const AutomaticOptions& automatic) {
  AutomaticSettings result;
  result.options = starting_options(*joint.model, joint.options, automatic);
  steady::Joint coarse = joint.with(result.options);
  coarse.options.linearise = true;
  const std::vector<steady::State> curve = paths::frequency_response(coarse, omega);
  for (const steady::State& state : curve) result.jacobians += state.iterations;
  result.solves = static_cast<int>(curve.size());
  result.points = demanding_points(curve);
  if (result.points.empty()) {
    result.status = curve.empty() ? Status::converged : curve.front().status;
    return result;
  }
  std::vector<AutomaticState> chosen(result.points.size());
  const auto choose = [&](std::size_t i, const steady::State& start) {
    steady::Joint from = joint.with(result.options);
    from.options.linearise = false;
    chosen[i] = chosen_from(from, omega[result.points[i]], automatic, start.displacement);
    result.solves += chosen[i].solves;
    result.jacobians += chosen[i].jacobians;
    result.options.harmonics = chosen[i].options.harmonics;
    result.options.samples = chosen[i].options.samples;
  };
  const auto at_final_settings = [&](const AutomaticState& state) {
    return state.options.harmonics == result.options.harmonics && state.options.samples == result.options.samples;
  };
  for (std::size_t i = 0; i < chosen.size(); ++i) choose(i, curve[result.points[i]]);
  // Settings only grow: points content with less than their successors needed are looked at again.
  while (!std::ranges::all_of(chosen, at_final_settings))
    for (std::size_t i = 0; i < chosen.size(); ++i)
      if (!at_final_settings(chosen[i])) {
        const steady::State start = std::move(chosen[i].state);
        choose(i, start);
      }
  result.status = Status::converged;
  for (AutomaticState& state : chosen) {
    if (result.status == Status::converged) result.status = state.status;
    result.bars.push_back(std::move(state.bars));
  }
  return result;
}

}  // namespace dovetail::quality
