#include "paths/continuation.hpp"

#include <array>

#include "paths/resonance.hpp"

namespace dovetail {

using paths::ContinuationOptions;
using paths::ResonanceOptions;

template <>
std::span<const Field<ContinuationOptions>> option_table<ContinuationOptions>() {
  using O = ContinuationOptions;
  static const std::vector<Field<O>> fields{
      {.key = "largest_frequency_step",
       .member = &O::largest_frequency_step,
       .range = {.lower = 0, .upper = 1, .lower_open = true}},
      {.key = "largest_change", .member = &O::largest_change, .range = kPositive},
      {.key = "largest_turn", .member = &O::largest_turn, .range = kPositive},
      {.key = "initial_step", .member = &O::initial_step, .range = kPositive},
      {.key = "smallest_step", .member = &O::smallest_step, .range = kPositive},
      {.key = "smallest_turn", .member = &O::smallest_turn, .range = {.lower = 0, .upper = 1}},
      {.key = "max_corrections", .member = &O::max_corrections, .range = {.lower = 2}},
      {.key = "max_points", .member = &O::max_points, .range = {.lower = 2}},
      {.key = "max_jacobians", .member = &O::max_jacobians, .range = {.lower = 0}},
      {.key = "locate_turns", .member = &O::locate_turns},
  };
  return fields;
}

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

}  // namespace dovetail
