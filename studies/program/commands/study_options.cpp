// Options of the commands on study files, runs and model files.
#include <array>

#include "studies/program/commands/commands.hpp"
#include "studies/program/study_file/export.hpp"

namespace dovetail::studies {
namespace {

template <class S>
Option<S> study_option() {
  return {"STUDY", &S::study, {}, "The study file (TOML)", true};
}

/// -o of a command that writes one file.
template <class S>
Option<S> output_option(std::string S::*member, std::string_view type, const char* help) {
  return {"-o,--output", member, type, help, true};
}

}  // namespace

template <>
std::span<const Option<CheckOptions>> command_options<CheckOptions>() {
  using C = CheckOptions;
  static const std::vector<Option<C>> table{
      study_option<C>(), set_option<C>(), {"--strict", &C::strict, {}, "Warnings count as errors: exit status 2"}};
  return table;
}

template <>
std::span<const Option<MaterialsOptions>> command_options<MaterialsOptions>() {
  static const std::vector<Option<MaterialsOptions>> table{json_option<MaterialsOptions>()};
  return table;
}

template <>
std::span<const Option<NewOptions>> command_options<NewOptions>() {
  static const std::vector<Option<NewOptions>> table{
      {"FILE", &NewOptions::file, {}, "The study file to write (TOML); must not exist", true},
      {"--template", &NewOptions::kind, "NAME",
       "What to start from: a plane section (the default), a sector in space, a robust design of several loads and "
       "uncertain numbers, or a front of two objectives"}};
  return table;
}

template <>
std::span<const Option<EvaluateOptions>> command_options<EvaluateOptions>() {
  using E = EvaluateOptions;
  static const std::vector<Option<E>> table{
      study_option<E>(),
      {"--no-bars", &E::no_bars, {}, "Responses alone, without their error bars: in a fraction of the time"},
      {"--no-history",
       &E::no_history,
       {},
       "The direct worn state stands where it is in doubt, as in a search: the wear history is asked only where the "
       "direct method finds none"},
      {"--unworn", &E::unworn, {}, "Responses of the joint before it wears, and limits on them, without error bars"},
      set_option<E>(),
      json_option<E>(),
      {.name = "--dakota",
       .member = &E::dakota,
       .type = "PARAMETERS RESULTS",
       .help =
           "Compute the design of a Dakota parameters file, and write what it asks for to its results file: variables "
           "are keys of the study, functions responses",
       .values = 2}};
  return table;
}

template <>
std::span<const Option<ReduceOptions>> command_options<ReduceOptions>() {
  using R = ReduceOptions;
  static const std::vector<Option<R>> table{study_option<R>(), set_option<R>(),
                                            output_option<R>(&R::model, "MODEL.h5", "The model file to write")};
  return table;
}

template <>
std::span<const Option<RunOptions>> command_options<RunOptions>() {
  using R = RunOptions;
  static const std::vector<Option<R>> table{
      study_option<R>(),
      set_option<R>(),
      {"-o,--output", &R::directory, "DIR", "Directory of the results (default: results/NAME)"},
      {"--resume", &R::resume, {}, "Continue the run stored in the directory"},
      {"--jobs",
       &R::jobs,
       "N",
       "Processes that work at once (default: one for each core, as many as memory has room for)",
       false,
       {.lower = 1}},
      {"--patience", &R::patience, "SECONDS", "A candidate for which one of several processes takes longer has failed",
       false, kPositive},
      {"--part", &R::part, "K/N",
       "Start and the K-th of N parts of the scan alone; `dovetail merge` puts the parts together"}};
  return table;
}

template <>
std::span<const Option<TellChoice>> command_options<TellChoice>() {
  using T = TellChoice;
  static const std::vector<Option<T>> table{
      {"--quiet", &T::quiet, {}, "Errors alone on standard error: no progress, warnings or remarks"},
      {"--json-log", &T::log, "FILE", "Write what happens to FILE as it does, a JSON object a line"}};
  return table;
}

template <>
std::span<const Option<ImportOptions>> command_options<ImportOptions>() {
  using I = ImportOptions;
  static const std::vector<Option<I>> table{{"INPUT", &I::input, {}, "The model (TOML)", true},
                                            output_option<I>(&I::model, "MODEL.h5", "The model file to write")};
  return table;
}

template <>
std::span<const Option<DeckOptions>> command_options<DeckOptions>() {
  using D = DeckOptions;
  static const std::vector<Option<D>> table{
      {"--nodal-diameter", &D::nodal_diameters, "N",
       "inp: nodal diameters of the frequency steps, separated by commas (default: the study's)"},
      {"--modes", &D::modes, "N", "inp: modes per nodal diameter", false, {.lower = 1}},
      {"--contact", &D::contact, {}, "inp: flanks in frictional contact, not glued"}};
  return table;
}

template <>
std::span<const Option<ExportOptions>> command_options<ExportOptions>() {
  using E = ExportOptions;
  static const std::vector<Option<E>> table = [] {
    return std::vector<Option<E>>{
        {"INPUT", &E::input, {}, "Directory of a run, a study file, or a reduced model", true},
        {"--format", &E::format, "NAME", "One of " + export_formats() + ", " + std::string(kMatrixMarket), true},
        output_option<E>(&E::file, "FILE", "The file to write"),
        set_option<E>(),
        {"--candidate",
         &E::candidate,
         "N",
         "Of a run: its evaluation of that number (default: the best design)",
         false,
         {.lower = 1}},
        {"--worn", &E::worn, {}, "step, iges, stl: the blade with its flanks worn as far as wear goes"}};
  }();
  return table;
}

template <>
std::span<const Option<MergeOptions>> command_options<MergeOptions>() {
  using M = MergeOptions;
  static const std::vector<Option<M>> table{
      {"DIR", &M::directories, {}, "Directories of runs of one study", true},
      {"-o,--output", &M::directory, "DIR", "Directory of the merged run, which is new", true}};
  return table;
}

template <>
std::span<const Option<ServeOptions>> command_options<ServeOptions>() {
  using S = ServeOptions;
  static const std::vector<Option<S>> table{
      study_option<S>(),
      set_option<S>(),
      {"--port", &S::port, "P", "The port (default 4242); 0: one that is free", false, {.lower = 0, .upper = 65535}},
      {"--host", &S::host, "ADDRESS", "Where it is heard (default 127.0.0.1: on this machine alone)"}};
  return table;
}

template <>
std::span<const Option<SchemaOptions>> command_options<SchemaOptions>() {
  static const std::vector<Option<SchemaOptions>> table{
      {"OF", &SchemaOptions::of, {}, "Of a study file, or of the JSON of that command", true}};
  return table;
}

template <>
std::span<const Option<CompletionOptions>> command_options<CompletionOptions>() {
  static const std::vector<Option<CompletionOptions>> table{
      {"FILE", &CompletionOptions::file, {}, "What completes in a shell, or the manual page", true}};
  return table;
}

template <>
std::span<const Option<RunsOptions>> command_options<RunsOptions>() {
  using R = RunsOptions;
  static const std::vector<Option<R>> table{
      {"DIR", &R::directories, {}, "Directories of runs, or directories that hold some", true},
      {"--csv", &R::csv, "FILE",
       "Write the table to FILE with all variables and responses of the best designs; - is standard output"},
      json_option<R>()};
  return table;
}

template <>
std::span<const Option<ReportOptions>> command_options<ReportOptions>() {
  using R = ReportOptions;
  static const std::vector<Option<R>> table{{"DIR", &R::directory, {}, "Directory of the run", true},
                                            output_option<R>(&R::file, "FILE.html", "The page to write")};
  return table;
}

}  // namespace dovetail::studies
