#include "paths/continuation.hpp"

#include <array>

#include "paths/resonance.hpp"

namespace dovetail {

using paths::ContinuationOptions;
using paths::ResonanceOptions;

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
