// Commands on what a run or a study left in files.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <ostream>

#include "core/replace_file.hpp"
#include "optimizer/cases.hpp"
#include "optimizer/journal/journal.hpp"
#include "reduction/model_file.hpp"
#include "studies/program/answers/field_export.hpp"
#include "studies/program/answers/geometry_export.hpp"
#include "studies/program/answers/solid_export.hpp"
#include "studies/program/answers/teller.hpp"
#include "studies/program/commands/commands.hpp"
#include "studies/program/engine/engine.hpp"
#include "studies/program/engine/loaded_model.hpp"
#include "studies/program/engine/model_toml.hpp"
#include "studies/program/engine/run_folder.hpp"
#include "studies/program/run/candidate_table.hpp"
#include "studies/program/run/run_clock.hpp"
#include "studies/program/study_file/best_file.hpp"
#include "studies/program/study_file/export.hpp"
#include "studies/program/study_file/refusal.hpp"
#include "studies/report/pages/report_html.hpp"
#include "studies/report/record/results_file.hpp"
#include "studies/report/words/report_words.hpp"

namespace dovetail::studies {
namespace {

namespace fs = std::filesystem;

report::RunRecord results_of(const std::string& directory) {
  return report::read_results(run_file(directory, "results.h5", "results"));
}

/// The study file of a candidate of a run, as best.toml is that of the best design.
Document candidate_document(const std::string& directory, int number) {
  const report::RunRecord record = results_of(directory);
  const auto count = static_cast<int>(record.evaluations.size());
  if (number > count)
    refuse("--candidate", fmt::format("must be 1 to {}: the run has no more evaluations", count),
           std::to_string(number));
  const Document searched = parse_document(record.provenance.study_text, record.provenance.study_file);
  const std::vector<double>& x = record.evaluations[static_cast<std::size_t>(number - 1)].x;
  return parse_document(with_values(searched, settings_at(read_study(searched), x)),
                        fmt::format("{}, candidate {}", directory, number));
}

bool has_worn_flanks(const report::DesignRecord& design) {
  return !design.contact.depth_m.empty() && optimizer::converged(design.status);
}

/// What is to be exported: a study, or a design of a run.
class Exported {
 public:
  Exported(const ExportOptions& options, Teller& teller)
      : options_(options), teller_(teller), of_run_(fs::is_directory(options.input)) {
    if (options.candidate && !of_run_)
      refuse("--candidate", "only has a meaning with the directory of a run", std::to_string(*options.candidate));
  }

  [[nodiscard]] bool of_run() const { return of_run_; }

  [[nodiscard]] Document document() const {
    if (options_.candidate) return candidate_document(options_.input, *options_.candidate);
    return load_document(of_run_ ? run_file(options_.input, "best.toml", "best design").string() : options_.input);
  }

  [[nodiscard]] Study study() const {
    Document document = this->document();
    apply_overrides(document, overrides(options_.set));
    return read_study(document);
  }

  /// With fields and contact; what a run keeps of its best design is not computed again where it has what is wanted: a
  /// run that asks for no wear keeps none.
  [[nodiscard]] report::DesignRecord design(bool history, bool worn) const {
    std::optional<report::RunRecord> of_best;
    if (of_run_ && !options_.candidate && options_.set.empty()) {
      teller_.begin("reading the results");
      of_best = results_of(options_.input);
    }
    const Study study = this->study();
    if (const std::vector<optimizer::LoadCase>& cases = study.problem.cases; cases.size() > 1)
      teller_.remark() << "dovetail: " << options_.input << ": of case " << cases.front().name
                       << ", the first, alone; what all cases wear off together is not drawn\n";
    if (of_best && of_best->best_design && of_best->best_design->fields.mesh.element_count() > 0 &&
        (!history || of_best->best_design->history) && (!worn || has_worn_flanks(*of_best->best_design)))
      return *of_best->best_design;
    teller_.begin(history ? "computing the design and its wear history" : "computing the design",
                  teller_.shows() && !history ? expected_cost(study).seconds : 0);
    report::DesignRecord design = describe_fields(study, history);
    if (design.fields.mesh.element_count() > 0) return design;
    if (optimizer::outcome_of(design.status) == optimizer::Outcome::infeasible)
      throw infeasible(options_.input, broken_rules(optimizer::in_first_case(study.scene, study.problem.cases)));
    refuse(options_.input, "the design has no fields: " + design.status);
  }

 private:
  const ExportOptions& options_;
  Teller& teller_;
  bool of_run_;
};

void check_export(const ExportOptions& options, std::optional<ExportFormat> format) {
  if (!format && options.format != kMatrixMarket) {
    std::vector<std::string_view> formats = names_of<ExportFormat>();
    formats.push_back(kMatrixMarket);
    refuse("--format", one_of(formats), options.format);
  }
  if (format != ExportFormat::inp && options.deck != DeckOptions{})
    refuse("--format", "must be inp with --nodal-diameter, --modes or --contact", options.format);
  if (options.worn && !(format && is_solid(*format)))
    refuse("--format", "must be step, iges or stl with --worn", options.format);
  if (options.candidate && format == ExportFormat::csv)
    refuse("--candidate", "has no meaning with csv: the table has all of them", std::to_string(*options.candidate));
  if (!options.set.empty() && format == ExportFormat::csv)
    refuse("--set", "has no meaning with csv: the table is of what a run computed", options.set.front());
  check_replaceable(options.file);
}

}  // namespace

int run_import(const ImportOptions& options, Teller& teller, const Streams& streams) {
  teller.begin("reading the model, and reducing it where it is a structure");
  const std::optional<reduction::ReducedModel> model = read_any_model(options.input);
  if (!model)
    refuse(options.input,
           "is not a reduced model: it does not say format = \"dovetail-reduced-model\"; of a study, `dovetail reduce` "
           "writes the model");
  reduction::write_model(options.model, *model);
  teller.end();
  streams.out << fmt::format("{}: {} coordinates, {} contact nodes\n", options.model, model->size(),
                             model->contact.count());
  return kDone;
}

namespace {

int export_model(const ExportOptions& options, const Exported& exported, Teller& teller, const Streams& streams) {
  const LoadedModel loaded =
      exported.of_run() ? told_model(exported.study(), teller) : told_model(options.input, options.set, {}, teller);
  teller.begin("writing " + options.file);
  if (!loaded.failure.empty()) return not_converged(options.input, "not converged: " + loaded.failure, streams);
  write_model_document(options.file, loaded.model, options.input);
  teller.end();
  streams.out << options.file << ": written, with three matrices beside it\n";
  return kDone;
}

}  // namespace

int run_export(const ExportOptions& options, Teller& teller, const Streams& streams) {
  const std::optional<ExportFormat> format = named<ExportFormat>(options.format);
  check_export(options, format);
  const Exported exported(options, teller);
  const bool of_run = exported.of_run();
  if (!format) return export_model(options, exported, teller, streams);
  if (!of_run && (is_hdf5_file(options.input) || is_model_document(load_document(options.input))))
    refuse(options.input, "is a reduced model: it has matrices (--format matrix-market), no geometry");
  if (format == ExportFormat::csv) {
    if (!of_run) refuse(options.input, "must be the directory of a run for csv, the table of its candidates");
    teller.begin("reading the results");
    replace_file(options.file, candidate_table(results_of(options.input)));
  } else if (has_fields(*format)) {
    const bool series = format == ExportFormat::pvd;
    const report::DesignRecord design = exported.design(series, false);
    teller.begin("writing " + options.file);
    (series ? export_history : export_fields)(design, options.file);
  } else if (options.worn) {
    const report::DesignRecord design = exported.design(false, true);
    if (!has_worn_flanks(design))
      refuse(options.input, "has no worn flanks: its wear has not come to an end (" + design.status + ")");
    // The record is of the first case.
    const Study study = exported.study();
    teller.begin("writing " + options.file);
    export_solids(optimizer::in_first_case(study.scene, study.problem.cases), *format, &design.contact, options.file);
  } else {
    const optimizer::Scene scene = exported.study().scene;
    const std::vector<std::string> broken = broken_rules(scene);
    teller.begin("writing " + options.file);
    try {
      export_geometry(scene, *format, options.deck, options.file);
    } catch (const InputError&) {
      if (broken.empty()) throw;
      throw infeasible(options.input, broken);
    }
    for (const std::string& rule : broken)
      teller.remark() << "dovetail: " << options.input << ": the design is infeasible: " << rule << "\n";
  }
  teller.end();
  streams.out << options.file << ": written\n";
  return kDone;
}

int run_report(const ReportOptions& options, Teller& teller, const Streams& streams) {
  teller.begin("reading the results, of which the report is made");
  const report::RunRecord record = results_of(options.directory);
  teller.begin("writing the report");
  report::write_report(options.file, record);
  teller.end();
  streams.out << options.file << ": written\n";
  return kDone;
}

namespace {

/// A directory that is gone again where what fills it throws.
class NewDirectory {
 public:
  explicit NewDirectory(fs::path path) : path_(std::move(path)) {
    std::error_code error;
    created_ = fs::create_directories(path_, error);
    if (error) refuse(path_.string(), "cannot be created: " + error.message());
  }
  ~NewDirectory() {
    std::error_code ignored;
    if (created_) fs::remove_all(path_, ignored);
  }
  NewDirectory(const NewDirectory&) = delete;
  NewDirectory& operator=(const NewDirectory&) = delete;

  void keep() { created_ = false; }

 private:
  fs::path path_;
  bool created_ = false;
};

}  // namespace

int run_merge(const MergeOptions& options, Teller& teller, const Streams& streams) {
  const fs::path merged(options.directory);
  std::error_code error;
  if (fs::exists(merged, error) && !fs::is_empty(merged, error))
    refuse(options.directory, "exists already; choose another directory for the merged run");
  NewDirectory made(merged);
  std::size_t evaluations = 0;
  const std::vector<std::string> names{"journal.jsonl", "finer.jsonl"};
  teller.begin("merging journals", 0, static_cast<int>(names.size()));
  for (const std::string& name : names) {
    std::vector<fs::path> files;
    for (const std::string& directory : options.directories) files.push_back(run_file(directory, name, "journal"));
    const std::size_t records = optimizer::merge_journals(files, merged / name);
    evaluations = std::max(evaluations, records);
    teller.step(name == names.front() ? 1 : 2);
  }
  // What the first of them searched with.
  for (const char* name : {"study.toml", "settings.json"})
    if (const fs::path file = fs::path(options.directories.front()) / name; fs::exists(file, error))
      fs::copy_file(file, merged / name, error);
  double seconds = 0;
  for (const std::string& directory : options.directories) seconds += seconds_taken(directory);
  keep_seconds_taken(merged, seconds);
  made.keep();
  teller.end();
  streams.out << fmt::format("{}: {} of {}\n", options.directory, report::counted(evaluations, "different evaluation"),
                             report::counted(options.directories.size(), "run"));
  return kDone;
}

}  // namespace dovetail::studies
