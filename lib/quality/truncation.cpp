#include "quality/truncation.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "paths/steady_state.hpp"
#include "quality/params.hpp"

namespace dovetail::quality {

TruncationFactors truncation_factors(bool massless) {
  constexpr BarParams kParams;
  return {.harmonics = massless ? kParams.harmonics : kParams.harmonics_with_mass,
          .samples = kParams.samples,
          .penalty = kParams.penalty};
}

int samples_for(int harmonics, int samples) {
  while (samples <= 4 * harmonics) samples *= 2;
  return samples;
}

steady::Options more_harmonics(steady::Options options) {
  options.harmonics = 2 * options.harmonics + 1;
  options.samples = samples_for(options.harmonics, options.samples);
  return options;
}

steady::Options more_samples(steady::Options options) {
  options.samples *= 2;
  return options;
}

double penalty_weight(const dynamics::CondensedModel& model, const steady::State& state) {
  const contact::PseudoPenalty best = contact::pseudo_penalty(model.local_stiffness(), model.directions());
  double octaves = 0;
  for (Eigen::Index i = 0; i < model.nodes(); ++i)
    octaves = std::max({octaves, std::abs(std::log2(state.penalty.normal(i) / best.normal(i))),
                        std::abs(std::log2(state.penalty.tangential(i) / best.tangential(i)))});
  return std::max(1.0, 2 * octaves);
}

Refinements refine(const steady::Joint& joint, const steady::State& state) {
  steady::Joint other = joint;
  other.options.linearise = false;
  steady::Options softer = other.options, stiffer = other.options;
  softer.penalty_scale *= 0.5;
  stiffer.penalty_scale *= 2;
  Refinements result{.harmonics = paths::refined_state(other.with(more_harmonics(other.options)), state),
                     .samples = paths::refined_state(other.with(more_samples(other.options)), state),
                     .softer = paths::refined_state(other.with(softer), state),
                     .stiffer = paths::refined_state(other.with(stiffer), state)};
  for (const steady::State* one : {&result.harmonics, &result.samples, &result.softer, &result.stiffer})
    result.jacobians += one->iterations;
  return result;
}

double bar_from(const ScalarChanges& changes, bool massless) {
  const TruncationFactors factors = truncation_factors(massless);
  return factors.harmonics * changes.harmonics + factors.samples * changes.samples +
         factors.penalty * std::max(changes.softer, changes.stiffer);
}

ErrorBars bars_from(const Quantities& value, const TruncationChanges& changes, double tolerance, bool massless) {
  const TruncationFactors factors = truncation_factors(massless);
  const auto times = [](double factor) { return [factor](double x) { return factor * x; }; };
  const auto larger = [](double a, double b) { return std::max(a, b); };
  const auto sum = [](double a, double b) { return a + b; };
  ErrorBars bars{.status = Status::converged,
                 .value = value,
                 .harmonics = transform(changes.harmonics, times(factors.harmonics)),
                 .samples = transform(changes.samples, times(factors.samples)),
                 .penalty = transform(combine(changes.softer, changes.stiffer, larger), times(factors.penalty))};
  const Quantities rest = transform(value, [=](double x) { return tolerance * std::abs(x); });
  bars.total = combine(combine(combine(bars.harmonics, bars.samples, sum), bars.penalty, sum), rest, sum);
  return bars;
}

ErrorBars bars_from(const steady::Joint& joint, const steady::State& state, const Refinements& refinements) {
  const dynamics::CondensedModel& model = *joint.model;
  const Quantities value = quantities(model, state);
  const std::array<const steady::State*, 4> states{&refinements.harmonics, &refinements.samples, &refinements.softer,
                                                   &refinements.stiffer};
  std::array<Quantities, 4> changes;
  Status status = Status::converged;
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (states[i]->status == Status::converged) {
      changes[i] = distance(quantities(model, *states[i]), value);
    } else {
      changes[i] = constant_quantities(value.amplitudes.size(), kInfinity);
      if (status == Status::converged) status = states[i]->status;
    }
  }
  const double weight = penalty_weight(model, state);
  for (const std::size_t i : {2u, 3u}) changes[i] = transform(changes[i], [=](double x) { return weight * x; });
  ErrorBars bars =
      bars_from(value, {.harmonics = changes[0], .samples = changes[1], .softer = changes[2], .stiffer = changes[3]},
                joint.options.tolerance, model.massless_contact());
  bars.status = status;
  bars.jacobians = refinements.jacobians;
  return bars;
}

}  // namespace dovetail::quality
