#include <array>

#include "wear/asymptote.hpp"
#include "wear/history.hpp"
#include "wear/implicit_history.hpp"

namespace dovetail {

template <>
std::span<const Field<wear::HistoryOptions>> option_table<wear::HistoryOptions>() {
  using Options = wear::HistoryOptions;
  static const std::array fields{
      Field<Options>{.key = "increment_um",
                     .member = &Options::increment,
                     .si_per_unit = 1e-6,
                     .range = kPositive,
                     .help = "largest increase of the wear depth per step; the error is first order in it"},
      Field<Options>{.key = "tolerance",
                     .member = &Options::tolerance,
                     .range = {.lower = 0, .upper = 0.5},
                     .help = "local error per step, relative to the largest depth; 0: not controlled"},
      Field<Options>{.key = "steps", .member = &Options::steps, .range = {.lower = 1}, .help = "steps at most"},
      Field<Options>{
          .key = "cycles", .member = &Options::cycles, .range = kNonNegative, .help = "cycles at most; 0: no limit"},
      Field<Options>{.key = "rate_fraction",
                     .member = &Options::rate_fraction,
                     .range = {.lower = 0, .upper = 1, .upper_open = true},
                     .help = "worn out when the largest rate fell below this fraction of the first one"},
      Field<Options>{.key = "rate_threshold_um_per_cycle",
                     .member = &Options::rate_threshold,
                     .si_per_unit = 1e-6,
                     .help = "worn out, too, when the largest rate fell below this; negative: from the model"},
      Field<Options>{.key = "halvings",
                     .member = &Options::halvings,
                     .range = {.lower = 0, .upper = 30},
                     .help = "times a step that does not converge is halved before giving up"},
      Field<Options>{.key = "predictor", .member = &Options::predictor, .help = "start steps from U - J^-1 J_W dW"},
      Field<Options>{.key = "follow",
                     .member = &Options::follow,
                     .help = "excite at the given frequency or at the moving resonance",
                     .choices = {"fixed", "resonance"}},
      Field<Options>{.key = "carry_slip",
                     .member = &Options::carry_slip,
                     .help = "start each march from the slip of the state before"},
      Field<Options>{
          .key = "finish", .member = &Options::finish, .help = "finish a worn-out history by the direct method"},
      Field<Options>{.key = "start_cycles",
                     .member = &Options::start_cycles,
                     .range = kNonNegative,
                     .help = "cycles behind the start of a resumed history"},
      Field<Options>{.key = "reference_rate_um_per_cycle",
                     .member = &Options::reference_rate,
                     .si_per_unit = 1e-6,
                     .range = kNonNegative,
                     .help = "largest rate of the first state of a resumed history; 0: that of the start"},
  };
  return fields;
}

template <>
std::span<const Field<wear::AsymptoteOptions>> option_table<wear::AsymptoteOptions>() {
  using Options = wear::AsymptoteOptions;
  static const std::array fields{
      Field<Options>{.key = "rate_threshold_um_per_cycle",
                     .member = &Options::rate_threshold,
                     .si_per_unit = 1e-6,
                     .help = "wear per cycle below which a loaded node counts as stuck; negative: from the model"},
      Field<Options>{.key = "relative_threshold",
                     .member = &Options::relative_threshold,
                     .range = {.lower = 0, .upper = 1, .upper_open = true},
                     .help = "the same, relative to the largest rate of the unworn state"},
      Field<Options>{.key = "reference_rate_um_per_cycle",
                     .member = &Options::reference_rate,
                     .si_per_unit = 1e-6,
                     .range = kNonNegative,
                     .help = "largest rate that certificate and relative threshold refer to; 0: that of the start"},
      Field<Options>{.key = "passes", .member = &Options::passes, .range = {.lower = 1}, .help = "passes of release"},
      Field<Options>{
          .key = "arbitration",
          .member = &Options::arbitration,
          .help =
              "when the implicit history has the last word: in doubt, where release did not settle, never or always",
          .choices = {"auto", "unsettled", "never", "always"}},
      Field<Options>{.key = "state_tolerance",
                     .member = &Options::state_tolerance,
                     .range = kPositive,
                     .help = "difference of depths, relative to the largest, below which two worn states are the same"},
      Field<Options>{.key = "history_tolerance",
                     .member = &Options::history_tolerance,
                     .range = {.lower = 0, .upper = 0.5, .lower_open = true},
                     .help = "local error per step of the implicit history, relative to the largest depth"},
      Field<Options>{.key = "certify",
                     .member = &Options::certify,
                     .help = "solve once more with the worn gap and contact everywhere"},
      Field<Options>{.key = "certificate_limit",
                     .member = &Options::certificate_limit,
                     .range = {.lower = 0, .upper = 1, .lower_open = true},
                     .help = "largest remaining wear rate, relative to the unworn one, of a certified worn state"},
      Field<Options>{.key = "certify_finer",
                     .member = &Options::certify_finer,
                     .help = "check the certificate at 2H+1 harmonics and 2N samples"},
  };
  return fields;
}

template <>
std::span<const Field<wear::ImplicitHistoryOptions>> option_table<wear::ImplicitHistoryOptions>() {
  using Options = wear::ImplicitHistoryOptions;
  static const std::array fields{
      Field<Options>{.key = "tolerance",
                     .member = &Options::tolerance,
                     .range = {.lower = 0, .upper = 0.5, .lower_open = true},
                     .help = "local error per step, relative to the largest depth"},
      Field<Options>{.key = "first_increment",
                     .member = &Options::first_increment,
                     .range = kPositive,
                     .help = "increase of depth in the first step over the largest local penetration"},
      Field<Options>{.key = "growth",
                     .member = &Options::growth,
                     .range = {.lower = 1, .lower_open = true},
                     .help = "largest growth of the step from one to the next"},
      Field<Options>{.key = "steps", .member = &Options::steps, .range = {.lower = 1}, .help = "steps at most"},
      Field<Options>{
          .key = "cycles", .member = &Options::cycles, .range = kNonNegative, .help = "cycles at most; 0: no limit"},
      Field<Options>{.key = "stage_iterations",
                     .member = &Options::stage_iterations,
                     .range = {.lower = 1},
                     .help = "Jacobians per stage of a step before it is cut"},
      Field<Options>{.key = "rate_fraction",
                     .member = &Options::rate_fraction,
                     .range = {.lower = 0, .upper = 1, .upper_open = true},
                     .help = "worn out when the largest rate fell below this fraction of the first one"},
      Field<Options>{.key = "rate_threshold_um_per_cycle",
                     .member = &Options::rate_threshold,
                     .si_per_unit = 1e-6,
                     .help = "worn out, too, when the largest rate fell below this; negative: from the model"},
      Field<Options>{.key = "level_depth",
                     .member = &Options::level_depth,
                     .range = {.lower = 1, .lower_open = true},
                     .help = "depth, over the largest local penetration, beyond which rates may have levelled out"},
      Field<Options>{.key = "level_change",
                     .member = &Options::level_change,
                     .range = {.lower = 0, .upper = 1, .lower_open = true, .upper_open = true},
                     .help = "change of the largest rate, while the depth doubles, below which it has levelled out"},
      Field<Options>{.key = "finish", .member = &Options::finish, .help = "finish by the direct method"},
      Field<Options>{.key = "start_cycles",
                     .member = &Options::start_cycles,
                     .range = kNonNegative,
                     .help = "cycles behind the start of a resumed history"},
      Field<Options>{.key = "reference_rate_um_per_cycle",
                     .member = &Options::reference_rate,
                     .si_per_unit = 1e-6,
                     .range = kNonNegative,
                     .help = "largest rate of the first state of a resumed history; 0: that of the start"},
  };
  return fields;
}

}  // namespace dovetail
