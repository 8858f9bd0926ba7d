#include <array>

#include "wear/asymptote.hpp"
#include "wear/history.hpp"

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
                     .range = kNonNegative,
                     .help = "worn out, too, when the largest rate fell below this"},
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
                     .range = kNonNegative,
                     .help = "wear per cycle below which a loaded node counts as stuck"},
      Field<Options>{.key = "relative_threshold",
                     .member = &Options::relative_threshold,
                     .range = {.lower = 0, .upper = 1, .upper_open = true},
                     .help = "the same, relative to the largest rate of the unworn state"},
      Field<Options>{.key = "passes", .member = &Options::passes, .range = {.lower = 1}, .help = "passes of release"},
      Field<Options>{.key = "confirm_by_history",
                     .member = &Options::confirm_by_history,
                     .help = "confirm that there is no asymptote by the history"},
      Field<Options>{.key = "confirm_increment",
                     .member = &Options::confirm_increment,
                     .range = kPositive,
                     .help = "increment of that history over the largest local penetration"},
      Field<Options>{.key = "confirm_steps",
                     .member = &Options::confirm_steps,
                     .range = {.lower = 1},
                     .help = "steps of that history"},
      Field<Options>{.key = "interpolate_edge",
                     .member = &Options::interpolate_edge,
                     .help = "place the edge of the worn zone between nodes"},
      Field<Options>{.key = "certify",
                     .member = &Options::certify,
                     .help = "solve once more with the worn gap and contact everywhere"},
      Field<Options>{.key = "certificate_limit",
                     .member = &Options::certificate_limit,
                     .range = {.lower = 0, .upper = 1, .lower_open = true},
                     .help = "largest remaining wear rate, relative to the unworn one, of a certified worn state"},
  };
  return fields;
}

}  // namespace dovetail
