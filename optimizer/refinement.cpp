#include "optimizer/refinement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "response/peak_shift.hpp"
#include "response/refined_state.hpp"
#include "wear/archard.hpp"

namespace dovetail::optimizer {

namespace {

constexpr double kUnknown = std::numeric_limits<double>::infinity();

response::SteadyOptions refined(response::SteadyOptions options) {
  options.harmonics = 2 * options.harmonics + 1;
  options.samples *= 2;
  return options;
}

/// How far a resonance and its friction energy move under finer settings.
struct ResonanceChange {
  double omega = kUnknown, amplitude = kUnknown, friction_energy = kUnknown;
};

ResonanceChange resonance_change(const CandidateModel& model, const response::Resonance& at,
                                 const Eigen::VectorXd& depth, const response::SteadyOptions& finer) {
  const response::ContactCondition condition{.wear_depth = depth, .released = {}, .slip_origin = {}};
  const response::PeakShift shift = response::peak_shift(model.condensed, at, 0, condition, finer);
  if (shift.state.status != Status::converged) return {};
  return {.omega = shift.omega,
          .amplitude = shift.amplitude,
          .friction_energy = std::abs(shift.state.friction_energy - at.state.friction_energy)};
}

void wear_bars(const CandidateResult& result, const response::SteadyOptions& finer,
               std::map<std::string, double>& bars) {
  const wear::Asymptote& asymptote = *result.asymptote;
  double& volume = bars["asymptotic_wear_volume_m3"];
  double& depth = bars["asymptotic_wear_depth_max_m"];
  volume = depth = 0;
  if (asymptote.largest_depth == 0) {
    // Every node sticks: no wear at these settings, and no measure of how near to slip finer ones would come.
    if (asymptote.unworn_rate.maxCoeff() > wear::AsymptoteOptions{}.rate_threshold) volume = depth = kUnknown;
    return;
  }

  response::ContactCondition condition;
  condition.released.assign(asymptote.released.begin(), asymptote.released.end());
  const response::SteadyState state =
      response::steady_state(result.model.condensed, result.unworn->omega, condition, finer,
                             response::padded(asymptote.steady.displacement, finer.harmonics));
  if (state.status != Status::converged) {
    volume = depth = kUnknown;
    return;
  }
  const reduction::ContactNodes& contact = result.model.reduction.model.contact;
  Eigen::VectorXd worn = Eigen::VectorXd::Zero(contact.count());
  for (Eigen::Index i = 0; i < contact.count(); ++i)
    if (asymptote.released[static_cast<std::size_t>(i)])
      worn(i) = std::max(0.0, state.nodes[static_cast<std::size_t>(i)].max_normal_displacement - contact.gap(i));
  const double edge = (asymptote.volume_bracket[1] - asymptote.volume_bracket[0]) / 2;
  volume = std::abs(wear::worn_volume(contact, worn) - asymptote.worn_volume) + edge;
  depth = std::abs(worn.maxCoeff() - asymptote.largest_depth) +
          std::abs(asymptote.interpolated_largest_depth - asymptote.largest_depth);
}

}  // namespace

std::map<std::string, double> error_estimates(const Scene& scene, const CandidateResult& result) {
  const response::SteadyOptions finer = refined(steady_options(scene.solver));
  const response::ResonanceOptions search;
  std::map<std::string, double> bars;

  const double reduction_error = std::abs(result.model.reduction.frequency_error(scene.loading.mode - 1));
  const ResonanceChange unworn = resonance_change(result.model, *result.unworn, {}, finer);
  const ResonanceChange worn =
      resonance_change(result.model, *result.worn, result.asymptote->interpolated_depth, finer);
  const double two_pi = 2 * std::numbers::pi;
  const auto frequency_bar = [&](const response::Resonance& at, const ResonanceChange& change) {
    return (change.omega + (search.frequency_tolerance + reduction_error) * at.omega) / two_pi;
  };
  bars["resonance_hz"] = frequency_bar(*result.unworn, unworn);
  bars["worn_resonance_hz"] = frequency_bar(*result.worn, worn);
  // The reduction shifts both resonances alike: it leaves the drift alone.
  bars["resonance_drift"] = (unworn.omega + worn.omega) / result.unworn->omega + 2 * search.frequency_tolerance;
  bars["peak_amplitude_m"] = unworn.amplitude;
  bars["worn_peak_amplitude_m"] = worn.amplitude;
  bars["dissipated_energy_j"] = unworn.friction_energy;
  wear_bars(result, finer, bars);
  return bars;
}

}  // namespace dovetail::optimizer
