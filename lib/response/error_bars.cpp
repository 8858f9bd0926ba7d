#include "response/error_bars.hpp"

#include <array>

#include "response/peak_shift.hpp"
#include "response/truncation.hpp"

namespace dovetail {
template <>
std::span<const Field<response::ErrorBarOptions>> option_table<response::ErrorBarOptions>() {
  using Options = response::ErrorBarOptions;
  static const std::array fields{Field<Options>{
      .key = "safety", .member = &Options::safety, .range = kPositive, .help = "factor on all error bars"}};
  return fields;
}
}  // namespace dovetail

namespace dovetail::response {
namespace {

void check(const ErrorBarOptions& options) {
  std::vector<Violation> found = violations(options);
  if (!found.empty()) throw InputError(std::move(found));
}

ErrorBars unknown(const CondensedModel& model, const SteadyState& state) {
  const Quantities infinite = constant_quantities(static_cast<Eigen::Index>(model.output_names().size()), kInfinity);
  return {.status = state.status,
          .value = quantities(model, state),
          .harmonics = infinite,
          .samples = infinite,
          .penalty = infinite,
          .total = infinite};
}

}  // namespace

ErrorBars error_bars(const std::shared_ptr<const CondensedModel>& model, const SteadyState& state,
                     const ContactCondition& condition, const SteadyOptions& options,
                     const ErrorBarOptions& bar_options) {
  validate(options);
  check(bar_options);
  if (state.status != Status::converged) return unknown(*model, state);
  return bars_from(*model, state, refine(model, state, condition, options), options, bar_options);
}

ResonanceBars error_bars(const std::shared_ptr<const CondensedModel>& model, const Resonance& resonance,
                         const ContactCondition& condition, const SteadyOptions& options,
                         const ResonanceOptions& resonance_options, const ErrorBarOptions& bar_options) {
  validate(options);
  check(bar_options);
  ResonanceBars bars{.status = resonance.status, .omega = kInfinity, .amplitude = kInfinity, .state = {}};
  if (resonance.status != Status::converged || resonance.state.status != Status::converged) {
    if (bars.status == Status::converged) bars.status = resonance.state.status;
    bars.state = unknown(*model, resonance.state);
    return bars;
  }
  SteadyOptions softer = options, stiffer = options;
  softer.penalty_scale *= 0.5;
  stiffer.penalty_scale *= 2;
  std::array<PeakShift, 4> shifts;
  const std::array<SteadyOptions, 4> settings{more_harmonics(options), more_samples(options), softer, stiffer};
  for (std::size_t i = 0; i < shifts.size(); ++i) {
    shifts[i] = peak_shift(model, resonance, resonance_options.output, condition, settings[i]);
    if (bars.status == Status::converged) bars.status = shifts[i].status;
    shifts[i].state.linearisation.reset();
  }
  const double weight = penalty_weight(*model, resonance.state);
  const auto bar = [&](double PeakShift::*entry) {
    return bar_options.safety * bar_from({.harmonics = shifts[0].*entry,
                                          .samples = shifts[1].*entry,
                                          .softer = weight * shifts[2].*entry,
                                          .stiffer = weight * shifts[3].*entry},
                                         model->massless_contact());
  };
  bars.omega = bar(&PeakShift::omega) + resonance_options.frequency_tolerance * resonance.omega;
  bars.amplitude = bar(&PeakShift::amplitude) + options.tolerance * resonance.amplitude;
  Refinements refined{.harmonics = std::move(shifts[0].state),
                      .samples = std::move(shifts[1].state),
                      .softer = std::move(shifts[2].state),
                      .stiffer = std::move(shifts[3].state)};
  for (const PeakShift& shift : shifts) refined.jacobians += shift.jacobians;
  bars.state = bars_from(*model, resonance.state, refined, options, bar_options);
  return bars;
}

}  // namespace dovetail::response
