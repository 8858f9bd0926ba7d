#include "optimizer/refinement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "response/peak_shift.hpp"
#include "response/refined_state.hpp"
#include "wear/archard.hpp"
#include "wear/partial_release.hpp"
#include "wear/passes.hpp"

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

/// Volume of the worn nodes with a neighbour on the flank's grid that bears, m^3: the edge of the zone lies somewhere
/// between the two, so that the nodal volume is known to about half of this.
double volume_at_edges(const CandidateModel& model, const wear::Asymptote& asymptote) {
  Eigen::VectorXd depth = Eigen::VectorXd::Zero(asymptote.depth.size());
  Eigen::Index first = 0;
  for (const fem::FlankCells& flank : model.cells.flanks) {
    const auto across = std::ssize(flank.across.front()) - 1, along = std::ssize(flank.across);
    const auto worn = [&](Eigen::Index i, Eigen::Index j) {
      return i < 0 || j < 0 || i >= across || j >= along || asymptote.depth(first + i + across * j) > 0;
    };
    for (Eigen::Index j = 0; j < along; ++j)
      for (Eigen::Index i = 0; i < across; ++i)
        if (!(worn(i - 1, j) && worn(i + 1, j) && worn(i, j - 1) && worn(i, j + 1)))
          depth(first + i + across * j) = asymptote.depth(first + i + across * j);
    first += across * along;
  }
  return wear::worn_volume(model.reduction.model.contact, depth);
}

/// The worn zones at the settings of `release`, from its unworn state: with edges between nodes where the asymptote has
/// them, otherwise of whole nodes. Empty when they are not known.
Eigen::VectorXd depth_at(wear::Release& release, const response::SteadyState& unworn, bool between_nodes) {
  const wear::AsymptoteOptions defaults;
  const double threshold = std::max(wear::no_wear_rate(defaults.rate_threshold, release.model(), unworn),
                                    defaults.relative_threshold * unworn.wear_rate.maxCoeff());
  if (between_nodes) {
    const wear::PartialRelease partial = wear::release_partially(release, unworn, threshold, defaults.passes);
    return partial.settled ? partial.depth : Eigen::VectorXd();
  }
  wear::Passes passes(release.model().nodes());
  passes.state = unworn;
  const wear::Control control;
  const wear::Ending ending = wear::release_slipping(release, threshold, defaults.passes, control, passes);
  return ending == wear::Ending::settled ? release.depth(passes.released, passes.state) : Eigen::VectorXd();
}

/// Of the asymptote at the unworn resonance; where the resonance was followed its bars stand, in proportion, for those
/// of the last one. Returns the depths at finer settings, empty when they are not known.
Eigen::VectorXd wear_bars(const CandidateResult& result, const response::SteadyOptions& finer,
                          std::map<std::string, double>& bars) {
  const wear::Asymptote& asymptote = result.held ? *result.held : *result.asymptote;
  double& volume = bars["asymptotic_wear_volume_m3"];
  double& depth = bars["asymptotic_wear_depth_max_m"];
  volume = depth = 0;
  if (asymptote.largest_depth == 0) {
    // Every node sticks: no wear at these settings, and no measure of how near to slip finer ones would come.
    if (asymptote.unworn_rate.maxCoeff() >
        wear::no_wear_rate(wear::AsymptoteOptions{}.rate_threshold, *result.model.condensed, result.unworn->state))
      volume = depth = kUnknown;
    return {};
  }

  // The worn zones again, from the unworn state at finer settings: they shift the edges as well as the depths.
  const wear::Control control;
  wear::Release release(result.model.condensed, result.unworn->omega, {}, finer, control);
  const response::SteadyState unworn =
      release.solve(std::vector<bool>(asymptote.released.size(), false),
                    response::padded(result.unworn->state.displacement, finer.harmonics));
  volume = depth = kUnknown;
  if (unworn.status != Status::converged) return {};
  const bool between_nodes = result.model.condensed->directions() == 2;
  const Eigen::VectorXd finer_depth = depth_at(release, unworn, between_nodes);
  if (finer_depth.size() == 0) return {};
  const reduction::ContactNodes& contact = result.model.reduction.model.contact;
  // Of what one node more or less in the zones would change, edges between nodes leave a few per cent: on dovetails of
  // 12 to 64 edges per flank 1 to 5 per cent. Edges that did not settle may be anywhere in between.
  const double edge = asymptote.edge_status == Status::converged ? 0.1 : 1.0;
  const double bracket = between_nodes ? edge * (asymptote.volume_bracket[1] - asymptote.volume_bracket[0])
                                       : 0.5 * volume_at_edges(result.model, asymptote);
  volume = std::abs(wear::worn_volume(contact, finer_depth) - asymptote.interpolated_volume) + bracket;
  depth = std::abs(finer_depth.maxCoeff() - asymptote.interpolated_largest_depth) +
          edge * std::abs(asymptote.largest_depth - asymptote.interpolated_largest_depth);
  if (asymptote.interpolated_volume > 0)
    depth += bracket / asymptote.interpolated_volume * asymptote.interpolated_largest_depth / 2;
  if (!result.held) return finer_depth;
  volume *= result.asymptote->interpolated_volume / asymptote.interpolated_volume;
  depth *= result.asymptote->interpolated_largest_depth / asymptote.interpolated_largest_depth;
  return {};
}

}  // namespace

std::map<std::string, double> error_estimates(const Scene& scene, const CandidateResult& result) {
  response::SteadyOptions finer = refined(steady_options(scene.solver));
  finer.budget = result.model.budget;
  const response::ResonanceOptions search;
  std::map<std::string, double> bars;

  const double reduction_error = std::abs(result.model.reduction.frequency_error(scene.loading.mode - 1));
  const ResonanceChange unworn = resonance_change(result.model, *result.unworn, {}, finer);
  // The worn joint at finer settings is worn differently, too.
  Eigen::VectorXd depth = wear_bars(result, finer, bars);
  if (depth.size() == 0 || result.held) depth = result.asymptote->interpolated_depth;
  const ResonanceChange worn = resonance_change(result.model, *result.worn, depth, finer);
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
  return bars;
}

}  // namespace dovetail::optimizer
