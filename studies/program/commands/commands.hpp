#pragma once

#include <functional>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/enum_names.hpp"
#include "core/options.hpp"
#include "optimizer/workers/worker_pool.hpp"
#include "studies/program/answers/geometry_export.hpp"
#include "studies/program/commands/option.hpp"
#include "studies/program/engine/loaded_model.hpp"
#include "studies/program/engine/run_engine.hpp"
#include "studies/program/questions/analysis_choice.hpp"
#include "studies/program/questions/tell_choice.hpp"
#include "studies/program/questions/wear_options.hpp"
#include "studies/program/study_file/study.hpp"
#include "studies/program/study_file/study_template.hpp"

namespace dovetail::studies {

class Teller;

/// Exit statuses of the program; 130 is an interruption.
enum ExitStatus : int { kDone = 0, kWrongInput = 2, kNotConverged = 3 };

/// Where a command talks to: answers to `out`, progress and remarks to `err`.
struct Streams {
  std::ostream& out;
  std::ostream& err;
};

/// Frequencies that may be asked for, in Hz: their squares and those of rad/s stay far from overflow.
inline constexpr Range kFrequencies{.lower = 0, .upper = 1e9, .lower_open = true};

/// Each command is a function from its options to an exit status; it throws InputError for wrong input, before it
/// computes or writes anything.

struct CheckOptions {
  std::string study;
  std::vector<std::string> set;  ///< KEY=VALUE, as given with --set
  bool strict = false;           ///< warnings are errors
  TellChoice tell = {};
};
int run_check(const CheckOptions& options, Teller& teller, const Streams& streams);

struct NewOptions {
  std::string file;
  Template kind = Template::section;
};
int run_new(const NewOptions& options, const Streams& streams);

struct MaterialsOptions {
  std::string json;  ///< file, "-" for standard output, empty for a table on standard output
};
int run_materials(const MaterialsOptions& options, const Streams& streams);

struct EvaluateOptions {
  std::string study;
  std::vector<std::string> set;  ///< KEY=VALUE, as given with --set
  SolverChoice solver;
  std::string json;  ///< file, "-" for standard output, empty for a table on standard output
  bool no_bars = false, no_history = false, unworn = false;
  std::vector<std::string> dakota = {};  ///< its parameters file, and the results file it reads
  TellChoice tell = {};
};
int run_evaluate(const EvaluateOptions& options, Teller& teller, const Streams& streams);

struct ReduceOptions {
  std::string study;
  std::string model;
  std::vector<std::string> set;  ///< KEY=VALUE, as given with --set
  TellChoice tell = {};
};
int run_reduce(const ReduceOptions& options, Teller& teller, const Streams& streams);

struct ResponseOptions {
  std::string input;             ///< MODEL.h5 or STUDY.toml
  std::vector<std::string> set;  ///< KEY=VALUE, as given with --set
  SolverChoice solver;
  double from_hz = 0, to_hz = 0;
  int points = 1;
  bool arclength = false;
  AnalysisChoice choice;
  std::string json;
  TellChoice tell = {};
};
int run_response(const ResponseOptions& options, Teller& teller, const Streams& streams);
/// The same at these frequencies, of which the ends count in an arc-length run; and of a model that is loaded.
int answer_response(const ResponseOptions& options, const std::vector<double>& hz, Teller& teller,
                    const Streams& streams);
int answer_response(const ResponseOptions& options, const std::vector<double>& hz, LoadedModel loaded, Teller& teller,
                    const Streams& streams);

/// What a backbone is over.
enum class BackboneOver {
  force,  ///< factor of its harmonics
  wear,   ///< largest depth, m
};
constexpr EnumNames<BackboneOver, 2> enum_names(BackboneOver) {
  return {{{BackboneOver::force, "force"}, {BackboneOver::wear, "wear"}}};
}
[[nodiscard]] constexpr std::string_view to_string(BackboneOver over) {
  return name_of(over);
}

struct BackboneOptions {
  std::string input;             ///< MODEL or STUDY.toml
  std::vector<std::string> set;  ///< KEY=VALUE, as given with --set
  SolverChoice solver;
  BackboneOver over = BackboneOver::force;
  double from = 0, to = 0;
  int points = 1;
  bool logarithmic = false;
  std::string output;                  ///< empty: the first
  std::optional<double> frequency_hz;  ///< where the first resonance is searched
  std::string json;
  TellChoice tell = {};
};
int run_backbone(const BackboneOptions& options, Teller& teller, const Streams& streams);

int run_wear(const WearOptions& options, Teller& teller, const Streams& streams);
/// The same of a model that is loaded.
int answer_wear(const WearOptions& options, LoadedModel loaded, Teller& teller, const Streams& streams);

struct RunOptions {
  std::string study;
  std::vector<std::string> set = {};  ///< KEY=VALUE, as given with --set
  std::string directory;              ///< empty: results/NAME
  bool resume = false;
  std::optional<int> jobs = {};  ///< processes that work at once; absent: one for each core, as far as memory goes
  double patience = 3600;        ///< s; one that takes longer for a candidate is given up
  std::string part = {};         ///< "K/N": start and the K-th of N parts of the scan alone; empty: the whole run
  TellChoice tell = {};
};
/// Makes others who work on the pieces of a run; null: the run does them itself.
using PoolFactory =
    std::function<std::unique_ptr<optimizer::WorkerPool>(const RunOptions& options, const optimizer::WorkerFactory&)>;
/// As many processes of this machine as the options say.
[[nodiscard]] std::unique_ptr<optimizer::WorkerPool> processes(const RunOptions& options,
                                                               const optimizer::WorkerFactory& factory);
int run_study(const RunOptions& options, const Streams& streams, const RunEngineFactory& engine,
              const PoolFactory& pools = processes);
/// The same of a study that is read. `told` hears of every candidate of the search; what it throws ends the run.
int run_study(const Study& study, const RunOptions& options, const Streams& streams, const RunEngineFactory& engine,
              const PoolFactory& pools = processes, const std::function<void(const optimizer::Progress&)>& told = {});

struct RunsOptions {
  std::vector<std::string> directories;
  std::string csv, json;  ///< files, "-" for standard output
};
int run_runs(const RunsOptions& options, const Streams& streams);

struct ServeOptions {
  std::string study;
  std::vector<std::string> set;  ///< KEY=VALUE, as given with --set
  int port = 4242;               ///< 0: one that is free
  std::string host = "127.0.0.1";
};
int run_serve(const ServeOptions& options, const Streams& streams);

/// What a schema is of.
enum class SchemaOf { study, evaluate, runs, materials };
constexpr EnumNames<SchemaOf, 4> enum_names(SchemaOf) {
  return {{{SchemaOf::study, "study"},
           {SchemaOf::evaluate, "evaluate"},
           {SchemaOf::runs, "runs"},
           {SchemaOf::materials, "materials"}}};
}
struct SchemaOptions {
  SchemaOf of = SchemaOf::study;
};
int run_schema(const SchemaOptions& options, const Streams& streams);

/// What the command line is written down as.
enum class ShellFile { bash, zsh, man };
constexpr EnumNames<ShellFile, 3> enum_names(ShellFile) {
  return {{{ShellFile::bash, "bash"}, {ShellFile::zsh, "zsh"}, {ShellFile::man, "man"}}};
}
struct CompletionOptions {
  ShellFile file = ShellFile::bash;
};

/// The format of the command export that writes a reduced model, not a drawing.
inline constexpr std::string_view kMatrixMarket = "matrix-market";

struct ImportOptions {
  std::string input;  ///< MODEL.toml
  std::string model;  ///< MODEL.h5
  TellChoice tell = {};
};
int run_import(const ImportOptions& options, Teller& teller, const Streams& streams);

struct ExportOptions {
  std::string input;             ///< results directory, STUDY.toml, MODEL.h5 or MODEL.toml
  std::vector<std::string> set;  ///< KEY=VALUE, as given with --set
  std::string format;
  std::string file;
  std::optional<int> candidate;  ///< number of an evaluation of a run, from 1; absent: its best design
  bool worn = false;             ///< solids with the flanks that wear leaves
  DeckOptions deck;              ///< of the format inp
  TellChoice tell = {};
};
int run_export(const ExportOptions& options, Teller& teller, const Streams& streams);

struct MergeOptions {
  std::vector<std::string> directories;
  std::string directory;  ///< of the merged run
  TellChoice tell = {};
};
int run_merge(const MergeOptions& options, Teller& teller, const Streams& streams);

struct ReportOptions {
  std::string directory;
  std::string file;
  TellChoice tell = {};
};
int run_report(const ReportOptions& options, Teller& teller, const Streams& streams);

template <class S>
[[nodiscard]] Option<S> input_option() {
  return {.name = "INPUT",
          .member = &S::input,
          .help = "A reduced model (HDF5, or TOML with Matrix Market files) or a study file (TOML)",
          .required = true};
}
template <class S>
[[nodiscard]] Option<S> set_option() {
  return {.name = "--set",
          .member = &S::set,
          .type = "KEY=VALUE",
          .help =
              "Replace a value of the study file before it is checked, e.g. --set geometry.neck_width_mm=9; may be "
              "repeated"};
}
template <class S>
[[nodiscard]] Option<S> json_option() {
  return {.name = "--json",
          .member = &S::json,
          .type = "FILE",
          .help = "Write the answer as JSON to FILE; - is standard output, and then nothing else goes there"};
}

/// The tables of all of them.
template <>
std::span<const Option<CheckOptions>> command_options<CheckOptions>();
template <>
std::span<const Option<NewOptions>> command_options<NewOptions>();
template <>
std::span<const Option<MaterialsOptions>> command_options<MaterialsOptions>();
template <>
std::span<const Option<EvaluateOptions>> command_options<EvaluateOptions>();
template <>
std::span<const Option<ReduceOptions>> command_options<ReduceOptions>();
template <>
std::span<const Option<ResponseOptions>> command_options<ResponseOptions>();
template <>
std::span<const Option<BackboneOptions>> command_options<BackboneOptions>();
template <>
std::span<const Option<WearOptions>> command_options<WearOptions>();
template <>
std::span<const Option<RunOptions>> command_options<RunOptions>();
template <>
std::span<const Option<ServeOptions>> command_options<ServeOptions>();
template <>
std::span<const Option<SchemaOptions>> command_options<SchemaOptions>();
template <>
std::span<const Option<CompletionOptions>> command_options<CompletionOptions>();
template <>
std::span<const Option<RunsOptions>> command_options<RunsOptions>();
template <>
std::span<const Option<ImportOptions>> command_options<ImportOptions>();
template <>
std::span<const Option<ExportOptions>> command_options<ExportOptions>();
template <>
std::span<const Option<ReportOptions>> command_options<ReportOptions>();
template <>
std::span<const Option<MergeOptions>> command_options<MergeOptions>();
template <>
std::span<const Option<SolverChoice>> command_options<SolverChoice>();
template <>
std::span<const Option<TellChoice>> command_options<TellChoice>();
template <>
std::span<const Option<AnalysisChoice>> command_options<AnalysisChoice>();
template <>
std::span<const Option<DeckOptions>> command_options<DeckOptions>();

/// The model that a command is about (engine.hpp); people hear that it is made, and how long that takes.
[[nodiscard]] LoadedModel told_model(const std::string& input, const std::vector<std::string>& set,
                                     const SolverChoice& solver, Teller& teller,
                                     std::optional<wear::Follow> follow = {});
/// The same of a study that is read.
[[nodiscard]] LoadedModel told_model(const Study& study, Teller& teller, std::optional<wear::Follow> follow = {});

/// Writes a command's JSON to where --json says: nowhere when empty, `out` for "-", else a file. Throws InputError.
void deliver_json(const std::string& where, const std::string& text, const Streams& streams);

/// Says on the error stream what of an answer is written where Ctrl-C ended it. @return the exit status for it
int interrupted(const std::string& kept, const Streams& streams);

/// Says that of `input` on the error stream. @return the exit status for it
int not_converged(const std::string& input, const std::string& what, const Streams& streams);

}  // namespace dovetail::studies
