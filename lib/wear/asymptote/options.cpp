#include "wear/asymptote/asymptote.hpp"

namespace dovetail {

template <>
std::span<const Field<wear::AsymptoteOptions>> option_table<wear::AsymptoteOptions>() {
  using O = wear::AsymptoteOptions;
  static const std::vector<Field<O>> fields{
      {.key = "rate_threshold_um_per_cycle", .member = &O::rate_threshold, .si_per_unit = 1e-6},
      {.key = "relative_threshold",
       .member = &O::relative_threshold,
       .range = {.lower = 0, .upper = 1, .upper_open = true}},
      {.key = "reference_rate_um_per_cycle", .member = &O::reference_rate, .si_per_unit = 1e-6, .range = kNonNegative},
      {.key = "passes", .member = &O::passes, .range = {.lower = 1}},
      {.key = "arbitration", .member = &O::arbitration},
      {.key = "state_tolerance", .member = &O::state_tolerance, .range = kPositive},
      {.key = "history_tolerance",
       .member = &O::history_tolerance,
       .range = {.lower = 0, .upper = 0.5, .lower_open = true}},
      {.key = "certify", .member = &O::certify},
      {.key = "certificate_limit",
       .member = &O::certificate_limit,
       .range = {.lower = 0, .upper = 1, .lower_open = true}},
      {.key = "certify_finer", .member = &O::certify_finer},
  };
  return fields;
}

}  // namespace dovetail
