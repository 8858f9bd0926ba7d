#include "wear/history/history.hpp"

namespace dovetail {

template <>
std::span<const Field<wear::HistoryOptions>> option_table<wear::HistoryOptions>() {
  using O = wear::HistoryOptions;
  static const std::vector<Field<O>> fields{
      {.key = "integrator", .member = &O::integrator},
      {.key = "increment_um", .member = &O::increment, .si_per_unit = 1e-6, .range = kPositive},
      {.key = "tolerance", .member = &O::tolerance, .range = {.lower = 0, .upper = 0.5}},
      {.key = "steps", .member = &O::steps, .range = {.lower = 1}},
      {.key = "cycles", .member = &O::cycles, .range = kNonNegative},
      {.key = "rate_fraction", .member = &O::rate_fraction, .range = {.lower = 0, .upper = 1, .upper_open = true}},
      {.key = "rate_threshold_um_per_cycle", .member = &O::rate_threshold, .si_per_unit = 1e-6},
      {.key = "follow", .member = &O::follow},
      {.key = "finish", .member = &O::finish},
  };
  return fields;
}

}  // namespace dovetail
