#include "response/continuation.hpp"

#include <array>

namespace dovetail {

using response::ContinuationOptions;

template <>
std::span<const Field<ContinuationOptions>> option_table<ContinuationOptions>() {
  static const std::array fields{
      Field<ContinuationOptions>{.key = "largest_frequency_step",
                                 .member = &ContinuationOptions::largest_frequency_step,
                                 .range = {.lower = 0, .upper = 1, .lower_open = true},
                                 .help = "between points, fraction of the interval"},
      Field<ContinuationOptions>{.key = "largest_change",
                                 .member = &ContinuationOptions::largest_change,
                                 .range = kPositive,
                                 .help = "of displacements and outputs between points, relative"},
      Field<ContinuationOptions>{.key = "largest_turn",
                                 .member = &ContinuationOptions::largest_turn,
                                 .range = kPositive,
                                 .help = "of the tangent between points, rad"},
      Field<ContinuationOptions>{.key = "initial_step",
                                 .member = &ContinuationOptions::initial_step,
                                 .range = kPositive,
                                 .help = "first step, arc length"},
      Field<ContinuationOptions>{.key = "smallest_step",
                                 .member = &ContinuationOptions::smallest_step,
                                 .range = kPositive,
                                 .help = "arc length at which the branch is given up"},
      Field<ContinuationOptions>{.key = "smallest_turn",
                                 .member = &ContinuationOptions::smallest_turn,
                                 .range = {.lower = 0, .upper = 1},
                                 .help = "reversal of the frequency that counts, fraction of the interval"},
      Field<ContinuationOptions>{.key = "max_corrections",
                                 .member = &ContinuationOptions::max_corrections,
                                 .range = {.lower = 2},
                                 .help = "Jacobians per point tried"},
      Field<ContinuationOptions>{.key = "max_points",
                                 .member = &ContinuationOptions::max_points,
                                 .range = {.lower = 2},
                                 .help = "points of the branch at most"},
      Field<ContinuationOptions>{.key = "max_jacobians",
                                 .member = &ContinuationOptions::max_jacobians,
                                 .range = {.lower = 0},
                                 .help = "Jacobians at most, rejected steps included; 0: no limit"},
      Field<ContinuationOptions>{.key = "locate_turns",
                                 .member = &ContinuationOptions::locate_turns,
                                 .help = "put a point on every turning point"},
  };
  return fields;
}

}  // namespace dovetail
