#include "paths/backbone.hpp"

namespace dovetail {

using paths::BackboneOptions;
using paths::ResonanceOptions;

template <>
std::span<const Field<ResonanceOptions>> option_table<ResonanceOptions>() {
  using O = ResonanceOptions;
  static const std::vector<Field<O>> fields{
      {.key = "output", .member = &O::output, .range = {.lower = 0}},
      {.key = "frequency_tolerance", .member = &O::frequency_tolerance, .range = kPositive},
      {.key = "search_range",
       .member = &O::search_range,
       .range = {.lower = 0, .upper = 1, .lower_open = true, .upper_open = true}},
      {.key = "sweep_range", .member = &O::sweep_range, .range = {.lower = 0, .upper = 1, .upper_open = true}},
      {.key = "max_solves", .member = &O::max_solves, .range = {.lower = 1}},
      {.key = "max_sweep_jacobians", .member = &O::max_sweep_jacobians, .range = {.lower = 1}},
  };
  return fields;
}

template <>
std::span<const Field<BackboneOptions>> option_table<BackboneOptions>() {
  using O = BackboneOptions;
  static const std::vector<Field<O>> fields{
      {.key = "max_iterations", .member = &O::max_iterations, .range = {.lower = 2}},
      {.key = "halvings", .member = &O::halvings, .range = kNonNegative},
      {.key = "search", .member = &O::search},
      {.key = "check_range", .member = &O::check_range, .range = {.lower = 0, .upper = 1, .upper_open = true}},
  };
  return fields;
}

}  // namespace dovetail
