#include "steady/options.hpp"

#include <array>

#include "steady/preload.hpp"

namespace dovetail {

using steady::Options;
using steady::PreloadOptions;

template <>
std::span<const Field<Options>> option_table<Options>() {
  static const std::array fields{
      Field<Options>{.key = "harmonics",
                     .member = &Options::harmonics,
                     .range = {.lower = 1},
                     .help = "harmonics of the periodic response"},
      Field<Options>{.key = "samples",
                     .member = &Options::samples,
                     .range = {.lower = 3},
                     .help = "time samples per period, more than twice the harmonics"},
      Field<Options>{.key = "tolerance",
                     .member = &Options::tolerance,
                     .range = kPositive,
                     .help = "residual force relative to the excitation"},
      Field<Options>{.key = "max_iterations",
                     .member = &Options::max_iterations,
                     .range = {.lower = 1},
                     .help = "Jacobians per attempt"},
      Field<Options>{.key = "solver",
                     .member = &Options::solver,
                     .help = "auto: Newton, then other pseudo-penalties, Powell, neighbouring problems",
                     .choices = {"auto", "newton", "powell", "powell_fd"}},
      Field<Options>{.key = "normal_penalty_n_per_m",
                     .member = &Options::normal_penalty,
                     .range = kNonNegative,
                     .help = "normal pseudo-penalty; 0: local contact stiffness"},
      Field<Options>{.key = "tangential_penalty_n_per_m",
                     .member = &Options::tangential_penalty,
                     .range = kNonNegative,
                     .help = "tangential pseudo-penalty; 0: local contact stiffness"},
      Field<Options>{.key = "penalty_scale",
                     .member = &Options::penalty_scale,
                     .range = kPositive,
                     .help = "factor on both pseudo-penalties"},
      Field<Options>{.key = "penalty_cascade",
                     .member = &Options::penalty_cascade,
                     .help = "try other pseudo-penalties when a solve fails"},
      Field<Options>{.key = "max_rescue_iterations",
                     .member = &Options::max_rescue_iterations,
                     .range = {.lower = 0},
                     .help = "Jacobians spent on neighbouring problems when all else failed"},
      Field<Options>{.key = "slip_return",
                     .member = &Options::slip_return,
                     .help = "time integration of slip in space",
                     .choices = {"first_order", "second_order"}},
      Field<Options>{.key = "max_periods",
                     .member = &Options::max_periods,
                     .range = {.lower = 2},
                     .help = "periods marched until the slip state repeats"},
      Field<Options>{.key = "periodic_tolerance",
                     .member = &Options::periodic_tolerance,
                     .range = kPositive,
                     .help = "change of the slip state over a period, relative"},
      Field<Options>{
          .key = "linearise", .member = &Options::linearise, .help = "keep the factorised Jacobian of the solution"},
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

}  // namespace dovetail

namespace dovetail::steady {

void validate(const Options& options) {
  std::vector<Violation> found = violations(options);
  if (options.samples <= 2 * options.harmonics)
    found.push_back({.file = {},
                     .key = "samples",
                     .value = std::to_string(options.samples),
                     .allowed = "must be > 2 * harmonics = " + std::to_string(2 * options.harmonics)});
  if (!found.empty()) throw InputError(std::move(found));
}

}  // namespace dovetail::steady
