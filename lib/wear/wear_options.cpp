#include <array>

#include "wear/asymptote.hpp"
#include "wear/history.hpp"
#include "wear/implicit_history.hpp"

namespace dovetail {

template <>
std::span<const Field<wear::HistoryOptions>> option_table<wear::HistoryOptions>() {
  using O = wear::HistoryOptions;
  static const std::vector<Field<O>> fields{
      {.key = "increment_um", .member = &O::increment, .si_per_unit = 1e-6, .range = kPositive},
      {.key = "tolerance", .member = &O::tolerance, .range = {.lower = 0, .upper = 0.5}},
      {.key = "steps", .member = &O::steps, .range = {.lower = 1}},
      {.key = "cycles", .member = &O::cycles, .range = kNonNegative},
      {.key = "rate_fraction", .member = &O::rate_fraction, .range = {.lower = 0, .upper = 1, .upper_open = true}},
      {.key = "rate_threshold_um_per_cycle", .member = &O::rate_threshold, .si_per_unit = 1e-6},
      {.key = "halvings", .member = &O::halvings, .range = {.lower = 0, .upper = 30}},
      {.key = "predictor", .member = &O::predictor},
      {.key = "follow", .member = &O::follow, .choices = {"fixed", "resonance"}},
      {.key = "carry_slip", .member = &O::carry_slip},
      {.key = "finish", .member = &O::finish},
      {.key = "start_cycles", .member = &O::start_cycles, .range = kNonNegative},
      {.key = "reference_rate_um_per_cycle", .member = &O::reference_rate, .si_per_unit = 1e-6, .range = kNonNegative},
  };
  return fields;
}

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
      {.key = "arbitration", .member = &O::arbitration, .choices = {"auto", "unsettled", "never", "always"}},
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

template <>
std::span<const Field<wear::ImplicitHistoryOptions>> option_table<wear::ImplicitHistoryOptions>() {
  using O = wear::ImplicitHistoryOptions;
  static const std::vector<Field<O>> fields{
      {.key = "tolerance", .member = &O::tolerance, .range = {.lower = 0, .upper = 0.5, .lower_open = true}},
      {.key = "first_increment", .member = &O::first_increment, .range = kPositive},
      {.key = "growth", .member = &O::growth, .range = {.lower = 1, .lower_open = true}},
      {.key = "steps", .member = &O::steps, .range = {.lower = 1}},
      {.key = "cycles", .member = &O::cycles, .range = kNonNegative},
      {.key = "stage_iterations", .member = &O::stage_iterations, .range = {.lower = 1}},
      {.key = "rate_fraction", .member = &O::rate_fraction, .range = {.lower = 0, .upper = 1, .upper_open = true}},
      {.key = "rate_threshold_um_per_cycle", .member = &O::rate_threshold, .si_per_unit = 1e-6},
      {.key = "level_depth", .member = &O::level_depth, .range = {.lower = 1, .lower_open = true}},
      {.key = "level_change",
       .member = &O::level_change,
       .range = {.lower = 0, .upper = 1, .lower_open = true, .upper_open = true}},
      {.key = "finish", .member = &O::finish},
      {.key = "start_cycles", .member = &O::start_cycles, .range = kNonNegative},
      {.key = "reference_rate_um_per_cycle", .member = &O::reference_rate, .si_per_unit = 1e-6, .range = kNonNegative},
  };
  return fields;
}

}  // namespace dovetail
