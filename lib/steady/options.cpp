#include "steady/options.hpp"

#include <array>

#include "steady/preload.hpp"

namespace dovetail {

using steady::Options;
using steady::PreloadOptions;

template <>
std::span<const Field<Options>> option_table<Options>() {
  using O = Options;
  static const std::vector<Field<O>> fields{
      {.key = "harmonics", .member = &O::harmonics, .range = {.lower = 1}},
      {.key = "samples", .member = &O::samples, .range = {.lower = 3}},
      {.key = "tolerance", .member = &O::tolerance, .range = kPositive},
      {.key = "max_iterations", .member = &O::max_iterations, .range = {.lower = 1}},
      {.key = "solver", .member = &O::solver},
      {.key = "normal_penalty_n_per_m", .member = &O::normal_penalty, .range = kNonNegative},
      {.key = "tangential_penalty_n_per_m", .member = &O::tangential_penalty, .range = kNonNegative},
      {.key = "penalty_scale", .member = &O::penalty_scale, .range = kPositive},
      {.key = "penalty_cascade", .member = &O::penalty_cascade},
      {.key = "max_rescue_iterations", .member = &O::max_rescue_iterations, .range = {.lower = 0}},
      {.key = "slip_return", .member = &O::slip_return},
      {.key = "max_periods", .member = &O::max_periods, .range = {.lower = 2}},
      {.key = "periodic_tolerance", .member = &O::periodic_tolerance, .range = kPositive},
      {.key = "linearise", .member = &O::linearise},
  };
  return fields;
}

template <>
std::span<const Field<PreloadOptions>> option_table<PreloadOptions>() {
  using O = PreloadOptions;
  static const std::vector<Field<O>> fields{
      {.key = "steps", .member = &O::steps, .range = {.lower = 1}},
      {.key = "halvings", .member = &O::halvings, .range = {.lower = 0, .upper = 30}},
      {.key = "tolerance", .member = &O::tolerance, .range = kPositive},
      {.key = "max_iterations", .member = &O::max_iterations, .range = {.lower = 1}},
      {.key = "normal_penalty_n_per_m", .member = &O::normal_penalty, .range = kNonNegative},
      {.key = "tangential_penalty_n_per_m", .member = &O::tangential_penalty, .range = kNonNegative},
  };
  return fields;
}

}  // namespace dovetail

namespace dovetail::steady {

Options Options::plain() const {
  Options options = *this;
  options.penalty_cascade = false;
  if (options.solver == Solver::automatic) options.solver = Solver::newton;
  return options;
}

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
