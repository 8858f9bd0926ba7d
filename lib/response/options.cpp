#include "response/options.hpp"

#include <array>

#include "response/preload.hpp"
#include "response/resonance.hpp"

namespace dovetail {

using response::PreloadOptions;
using response::ResonanceOptions;
using response::SteadyOptions;

template <>
std::span<const Field<SteadyOptions>> option_table<SteadyOptions>() {
  static const std::array fields{
      Field<SteadyOptions>{.key = "harmonics",
                           .member = &SteadyOptions::harmonics,
                           .range = {.lower = 1},
                           .help = "harmonics of the periodic response"},
      Field<SteadyOptions>{.key = "samples",
                           .member = &SteadyOptions::samples,
                           .range = {.lower = 3},
                           .help = "time samples per period, more than twice the harmonics"},
      Field<SteadyOptions>{.key = "tolerance",
                           .member = &SteadyOptions::tolerance,
                           .range = kPositive,
                           .help = "residual force relative to the excitation"},
      Field<SteadyOptions>{.key = "max_iterations",
                           .member = &SteadyOptions::max_iterations,
                           .range = {.lower = 1},
                           .help = "Jacobians per attempt"},
      Field<SteadyOptions>{.key = "solver",
                           .member = &SteadyOptions::solver,
                           .help = "auto: Newton, then other pseudo-penalties, Powell, neighbouring problems",
                           .choices = {"auto", "newton", "powell", "powell_fd"}},
      Field<SteadyOptions>{.key = "normal_penalty_n_per_m",
                           .member = &SteadyOptions::normal_penalty,
                           .range = kNonNegative,
                           .help = "normal pseudo-penalty; 0: local contact stiffness"},
      Field<SteadyOptions>{.key = "tangential_penalty_n_per_m",
                           .member = &SteadyOptions::tangential_penalty,
                           .range = kNonNegative,
                           .help = "tangential pseudo-penalty; 0: local contact stiffness"},
      Field<SteadyOptions>{.key = "penalty_scale",
                           .member = &SteadyOptions::penalty_scale,
                           .range = kPositive,
                           .help = "factor on both pseudo-penalties"},
      Field<SteadyOptions>{.key = "penalty_cascade",
                           .member = &SteadyOptions::penalty_cascade,
                           .help = "try other pseudo-penalties when a solve fails"},
      Field<SteadyOptions>{.key = "max_rescue_iterations",
                           .member = &SteadyOptions::max_rescue_iterations,
                           .range = {.lower = 0},
                           .help = "Jacobians spent on neighbouring problems when all else failed"},
      Field<SteadyOptions>{.key = "slip_return",
                           .member = &SteadyOptions::slip_return,
                           .help = "time integration of slip in space",
                           .choices = {"first_order", "second_order"}},
      Field<SteadyOptions>{.key = "max_periods",
                           .member = &SteadyOptions::max_periods,
                           .range = {.lower = 2},
                           .help = "periods marched until the slip state repeats"},
      Field<SteadyOptions>{.key = "periodic_tolerance",
                           .member = &SteadyOptions::periodic_tolerance,
                           .range = kPositive,
                           .help = "change of the slip state over a period, relative"},
      Field<SteadyOptions>{.key = "linearise",
                           .member = &SteadyOptions::linearise,
                           .help = "keep the factorised Jacobian of the solution"},
  };
  return fields;
}

template <>
std::span<const Field<PreloadOptions>> option_table<PreloadOptions>() {
  static const std::array fields{
      Field<PreloadOptions>{.key = "steps",
                            .member = &PreloadOptions::steps,
                            .range = {.lower = 1},
                            .help = "load steps from zero to the full static force"},
      Field<PreloadOptions>{.key = "halvings",
                            .member = &PreloadOptions::halvings,
                            .range = {.lower = 0, .upper = 30},
                            .help = "times a load step that does not converge is halved"},
      Field<PreloadOptions>{.key = "tolerance",
                            .member = &PreloadOptions::tolerance,
                            .range = kPositive,
                            .help = "residual relative to the static force"},
      Field<PreloadOptions>{.key = "max_iterations",
                            .member = &PreloadOptions::max_iterations,
                            .range = {.lower = 1},
                            .help = "Jacobians per attempt"},
      Field<PreloadOptions>{.key = "normal_penalty_n_per_m",
                            .member = &PreloadOptions::normal_penalty,
                            .range = kNonNegative,
                            .help = "normal pseudo-penalty; 0: local contact stiffness"},
      Field<PreloadOptions>{.key = "tangential_penalty_n_per_m",
                            .member = &PreloadOptions::tangential_penalty,
                            .range = kNonNegative,
                            .help = "tangential pseudo-penalty; 0: local contact stiffness"},
  };
  return fields;
}

template <>
std::span<const Field<ResonanceOptions>> option_table<ResonanceOptions>() {
  static const std::array fields{
      Field<ResonanceOptions>{.key = "output",
                              .member = &ResonanceOptions::output,
                              .range = {.lower = 0},
                              .help = "index of the monitored output"},
      Field<ResonanceOptions>{.key = "frequency_tolerance",
                              .member = &ResonanceOptions::frequency_tolerance,
                              .range = kPositive,
                              .help = "relative, of the resonance frequency"},
      Field<ResonanceOptions>{.key = "search_range",
                              .member = &ResonanceOptions::search_range,
                              .range = {.lower = 0, .upper = 1, .lower_open = true, .upper_open = true},
                              .help = "largest relative move away from the start"},
      Field<ResonanceOptions>{.key = "sweep_range",
                              .member = &ResonanceOptions::sweep_range,
                              .range = {.lower = 0, .upper = 1, .upper_open = true},
                              .help = "range of the branch that is followed when the search fails; 0: none"},
      Field<ResonanceOptions>{.key = "max_solves",
                              .member = &ResonanceOptions::max_solves,
                              .range = {.lower = 1},
                              .help = "steady states computed at most next to the start"},
      Field<ResonanceOptions>{.key = "max_sweep_jacobians",
                              .member = &ResonanceOptions::max_sweep_jacobians,
                              .range = {.lower = 1},
                              .help = "Jacobians spent at most on following the branch"},
  };
  return fields;
}

}  // namespace dovetail

namespace dovetail::response {

void validate(const SteadyOptions& options) {
  std::vector<Violation> found = violations(options);
  if (options.samples <= 2 * options.harmonics)
    found.push_back({.file = {},
                     .key = "samples",
                     .value = std::to_string(options.samples),
                     .allowed = "must be > 2 * harmonics = " + std::to_string(2 * options.harmonics)});
  if (!found.empty()) throw InputError(std::move(found));
}

}  // namespace dovetail::response
