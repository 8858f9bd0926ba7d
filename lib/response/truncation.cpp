#include "response/truncation.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "response/refined_state.hpp"

namespace dovetail::response {
namespace {

constexpr double kHarmonics = 2, kHarmonicsWithMass = 4, kSamples = 3, kPenalty = 0.25;

}  // namespace

TruncationFactors truncation_factors(bool massless) {
  return {.harmonics = massless ? kHarmonics : kHarmonicsWithMass, .samples = kSamples, .penalty = kPenalty};
}

SteadyOptions more_harmonics(SteadyOptions options) {
  options.harmonics = 2 * options.harmonics + 1;
  // The highest harmonics of a series of N samples alias each other.
  while (options.samples <= 4 * options.harmonics) options.samples *= 2;
  return options;
}

SteadyOptions more_samples(SteadyOptions options) {
  options.samples *= 2;
  return options;
}

double penalty_weight(const CondensedModel& model, const SteadyState& state) {
  const contact::PseudoPenalty best = contact::pseudo_penalty(model.local_stiffness(), model.directions());
  double octaves = 0;
  for (Eigen::Index i = 0; i < model.nodes(); ++i)
    octaves = std::max({octaves, std::abs(std::log2(state.penalty.normal(i) / best.normal(i))),
                        std::abs(std::log2(state.penalty.tangential(i) / best.tangential(i)))});
  return std::max(1.0, 2 * octaves);
}

Refinements refine(const std::shared_ptr<const CondensedModel>& model, const SteadyState& state,
                   const ContactCondition& condition, const SteadyOptions& options) {
  SteadyOptions other = options;
  other.linearise = false;
  SteadyOptions softer = other, stiffer = other;
  softer.penalty_scale *= 0.5;
  stiffer.penalty_scale *= 2;
  Refinements result{.harmonics = refined_state(model, state, condition, more_harmonics(other)),
                     .samples = refined_state(model, state, condition, more_samples(other)),
                     .softer = refined_state(model, state, condition, softer),
                     .stiffer = refined_state(model, state, condition, stiffer)};
  for (const SteadyState* one : {&result.harmonics, &result.samples, &result.softer, &result.stiffer})
    result.jacobians += one->iterations;
  return result;
}

double bar_from(const ScalarChanges& changes, bool massless) {
  const TruncationFactors factors = truncation_factors(massless);
  return factors.harmonics * changes.harmonics + factors.samples * changes.samples +
         factors.penalty * std::max(changes.softer, changes.stiffer);
}

ErrorBars bars_from(const Quantities& value, const TruncationChanges& changes, double tolerance, double safety,
                    bool massless) {
  const TruncationFactors factors = truncation_factors(massless);
  const auto times = [safety](double factor) { return [factor, safety](double x) { return safety * factor * x; }; };
  const auto larger = [](double a, double b) { return std::max(a, b); };
  const auto sum = [](double a, double b) { return a + b; };
  ErrorBars bars{.status = Status::converged,
                 .value = value,
                 .harmonics = transform(changes.harmonics, times(factors.harmonics)),
                 .samples = transform(changes.samples, times(factors.samples)),
                 .penalty = transform(combine(changes.softer, changes.stiffer, larger), times(factors.penalty))};
  const Quantities rest = transform(value, [=](double x) { return safety * tolerance * std::abs(x); });
  bars.total = combine(combine(combine(bars.harmonics, bars.samples, sum), bars.penalty, sum), rest, sum);
  return bars;
}

ErrorBars bars_from(const CondensedModel& model, const SteadyState& state, const Refinements& refinements,
                    const SteadyOptions& options, const ErrorBarOptions& bar_options) {
  const Quantities value = quantities(model, state);
  const std::array<const SteadyState*, 4> states{&refinements.harmonics, &refinements.samples, &refinements.softer,
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
                options.tolerance, bar_options.safety, model.massless_contact());
  bars.status = status;
  bars.jacobians = refinements.jacobians;
  return bars;
}

}  // namespace dovetail::response
