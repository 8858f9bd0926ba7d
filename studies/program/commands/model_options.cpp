// Options of the commands on a reduced model: response, backbone, wear.
#include <algorithm>
#include <cassert>

#include "optimizer/scene/scene.hpp"
#include "studies/program/commands/commands.hpp"
#include "studies/program/study_file/key_words.hpp"
#include "studies/program/study_file/study_template.hpp"

namespace dovetail::studies {

using enum Meaning::Kind;

template <>
std::span<const Option<SolverChoice>> command_options<SolverChoice>() {
  static const std::vector<Option<SolverChoice>> table = [] {
    std::vector<Option<SolverChoice>> rows;
    for (const SolverKey& key : solver_keys()) {
      const auto fields = option_table<optimizer::SolverSettings>();
      const auto field = std::ranges::find(fields, key.key, &Field<optimizer::SolverSettings>::key);
      assert(field != fields.end());
      const std::string unit = unit_of_key(key.key);
      rows.push_back({key.option(), key.member, key.type,
                      capitalised(field->help) + (unit.empty() ? "" : "; in " + unit) +
                          (key.automatic ? "; auto: as many as the error bars ask for" : ""),
                      false, kAnyNumber, choices_of(*field)});
    }
    rows.push_back(
        {"--accuracy",
         &SolverChoice::accuracy,
         "A",
         "Relative error bar of amplitudes that auto has to reach, of energies ten times that (default: 1e-3)",
         false,
         {.lower = 1e-8, .upper = 1},
         {},
         {{only_with, "--harmonics auto or --samples auto"}}});
    return rows;
  }();
  return table;
}

template <>
std::span<const Option<AnalysisChoice>> command_options<AnalysisChoice>() {
  using C = AnalysisChoice;
  static const std::vector<Option<C>> table{
      {"--error-bars", &C::error_bars, {}, "How far harmonics, samples and pseudo-penalty may have moved each result"},
      {"--penalty-sensitivity",
       &C::penalty_sensitivity,
       {},
       "Each result for 0.5, 1, 2 and 10 times the pseudo-penalty, and its logarithmic slope"},
      {"--stability",
       &C::stability,
       {},
       "Local stability of each periodic solution, with its multipliers; says where it has no meaning"},
      {"--traction-bounds",
       &C::traction_bounds,
       {},
       "Least and largest result found over the admissible residual tractions of stuck nodes, at up to three thousand "
       "steady states per frequency"}};
  return table;
}

template <>
std::span<const Option<ResponseOptions>> command_options<ResponseOptions>() {
  using R = ResponseOptions;
  static const std::vector<Option<R>> table{
      input_option<R>(),
      {"--from", &R::from_hz, "HZ", "First frequency", true, kFrequencies},
      {"--to", &R::to_hz, "HZ", "Last frequency", true, kFrequencies},
      {"--points", &R::points, "N", "Number of frequencies, evenly spaced", true, {.lower = 1, .upper = 1000000}},
      {"--arclength",
       &R::arclength,
       {},
       "Follow the response from --from through its turning points until it leaves the interval; the frequencies are "
       "then those of the points computed, at most 1/(N-1) of the interval apart"},
      set_option<R>(),
      json_option<R>()};
  return table;
}

template <>
std::span<const Option<BackboneOptions>> command_options<BackboneOptions>() {
  using B = BackboneOptions;
  const Meaning positive{not_with, "--over force", "0", "must be > 0 with --over force"};
  static const std::vector<Option<B>> table{
      input_option<B>(),
      {"--over", &B::over, "WHAT",
       "force: the parameter multiplies the harmonics of the force, not its static part; wear: it is the largest "
       "depth, m, of wear in proportion to the rates of the unworn resonance (default: force)"},
      {"--from", &B::from, "X", "First value of the parameter", true, kNonNegative, {}, {positive}},
      {"--to", &B::to, "X", "Last value of the parameter", true, kNonNegative, {}, {positive}},
      {"--points", &B::points, "N", "Number of values", true, {.lower = 1, .upper = 100000}},
      {"--logarithmic",
       &B::logarithmic,
       {},
       "Space the values evenly on a logarithmic scale",
       false,
       kAnyNumber,
       {},
       {{not_with, "--from 0 or --to 0", "", "needs --from > 0 and --to > 0"}}},
      {"--output", &B::output, "NAME", "Name of the output that resonates (default: the first)"},
      {"--frequency", &B::frequency_hz, "HZ",
       "Where the first resonance is searched (default: the natural frequency of the study's mode, of a model's "
       "lowest)",
       false, kFrequencies},
      set_option<B>(),
      json_option<B>()};
  return table;
}

namespace {

using W = WearOptions;
const std::string_view kHistory = "--method history";
const std::string_view kBand = "--follow band";

std::vector<Option<W>> drive_options() {
  return {
      {"--method", &W::method, "METHOD", "history or asymptote", true},
      {"--frequency",
       &W::frequency_hz,
       "HZ",
       "Excitation frequency (default: the unworn resonance of the study's mode, of a model's lowest)",
       false,
       kFrequencies,
       {},
       {{not_with, kBand}}},
      {"--follow",
       &W::follow,
       "WHAT",
       "fixed: the frequency stays; resonance: it tracks the moving resonance (not with --integrator implicit); band: "
       "the worst of several held ones (default: loading.follow of a study, fixed for a model)",
       false,
       kAnyNumber,
       {},
       {{not_with, "--integrator implicit", "resonance", "needs --integrator explicit"}}},
      {"--band-from",
       &W::band_from_hz,
       "HZ",
       "First frequency of the band",
       false,
       kFrequencies,
       {},
       {{only_with, kBand}, {needed_with, kBand}}},
      {"--band-to",
       &W::band_to_hz,
       "HZ",
       "Last frequency of the band",
       false,
       kFrequencies,
       {},
       {{only_with, kBand}, {needed_with, kBand}}},
      {"--band-points",
       &W::band_points,
       "N",
       "Frequencies of the band (default: 11)",
       false,
       {.lower = 1},
       {},
       {{only_with, kBand}}},
  };
}

std::vector<Option<W>> history_options() {
  return {
      {"--cycles", &W::cycles, "N", "history: end after so many cycles", false, kPositive, {}, {{only_with, kHistory}}},
      {"--steps",
       &W::steps,
       "N",
       "history: steps at most (default: 1000)",
       false,
       {.lower = 1},
       {},
       {{only_with, kHistory}}},
      {"--increment",
       &W::increment_m,
       "M",
       "explicit history: largest increase of depth per step, m (default: a hundredth of the largest depth of the "
       "directly computed worn state, or of the elastic penetration where there is none)",
       false,
       kPositive,
       {},
       {{only_with, kHistory},
        {not_with, "--integrator implicit", "", "has no meaning with --integrator implicit: see --history-tolerance"}}},
      {"--integrator",
       &W::integrator,
       "WHICH",
       "history: explicit, by increments of depth; or implicit, in large steps of controlled error (default: explicit; "
       "under an energy threshold implicit, unless with --follow resonance or --increment)",
       false,
       kAnyNumber,
       {},
       {{only_with, kHistory}}},
      {"--history-tolerance",
       &W::history_tolerance,
       "X",
       "Local error per step of a history, relative to the depth (default: explicit 0, increments as they are; "
       "implicit 2e-4), or of the history that decides where an asymptote is in doubt (default: "
       "solver.history_tolerance of a "
       "study, 2e-3 for a model)",
       false,
       {.lower = 0, .upper = 0.5},
       {},
       {{not_with, "--integrator implicit", "0", "must be > 0 with --integrator implicit"},
        {not_with, "--method asymptote", "0", "must be > 0 with --method asymptote"}}},
      {"--resume",
       &W::resume,
       "FILE",
       "history: go on from the last state in this file, which --json of another history of the same model at the same "
       "settings has written; the answer begins with the states in it, and --steps counts the new ones",
       false,
       kAnyNumber,
       {},
       {{only_with, kHistory},
        {not_with, "--follow band or --error-bars or --spread", "",
         "goes on with one history: no --follow band, --error-bars or --spread"}}},
      {"--curves",
       &W::curves,
       "N",
       "history: response curves of so many of its states, evenly spaced in worn volume (default: 0)",
       false,
       kNonNegative,
       {},
       {{only_with, kHistory}}},
      {"--curve-points",
       &W::curve_points,
       "M",
       "Frequencies of each curve (default: 60)",
       false,
       {.lower = 1},
       {},
       {{only_with, "--curves"}}},
      {"--curve-from",
       &W::curve_from_hz,
       "HZ",
       "First frequency of the curves (default: around the peaks)",
       false,
       kFrequencies,
       {},
       {{only_with, "--curve-to"}}},
      {"--curve-to",
       &W::curve_to_hz,
       "HZ",
       "Last frequency of the curves",
       false,
       kFrequencies,
       {},
       {{only_with, "--curve-from"}}},
  };
}

}  // namespace

template <>
std::span<const Option<WearOptions>> command_options<WearOptions>() {
  static const std::vector<Option<W>> table = [] {
    std::vector<Option<W>> rows{input_option<W>()};
    for (const Option<W>& option : drive_options()) rows.push_back(option);
    for (const Option<W>& option : history_options()) rows.push_back(option);
    rows.push_back(
        {"--error-bars",
         &W::error_bars,
         {},
         "How far harmonics, samples and pseudo-penalty may have moved volume and depth: four computations more"});
    rows.push_back(
        {"--spread",
         &W::spread,
         {},
         "How the worn state depends on what is not known: wear coefficient +-50 %, friction +-20 %, excitation +-10 "
         "%, residual tractions of stuck nodes, and all together: ten to fifteen computations more"});
    rows.push_back(set_option<W>());
    rows.push_back(json_option<W>());
    return rows;
  }();
  return table;
}

}  // namespace dovetail::studies
