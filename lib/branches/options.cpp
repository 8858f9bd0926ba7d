#include "branches/follow.hpp"

namespace dovetail {

using branches::FollowOptions;

template <>
std::span<const Field<FollowOptions>> option_table<FollowOptions>() {
  using O = FollowOptions;
  static const std::vector<Field<O>> fields{
      {.key = "largest_parameter_step",
       .member = &O::largest_parameter_step,
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

}  // namespace dovetail
