// Commands on what a run or a study left in files.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <ostream>

#include "core/replace_file.hpp"
#include "optimizer/journal/journal.hpp"
#include "reduction/model_file.hpp"
#include "studies/program/answers/field_export.hpp"
#include "studies/program/answers/geometry_export.hpp"
#include "studies/program/commands/commands.hpp"
#include "studies/program/engine/engine.hpp"
#include "studies/program/engine/model_toml.hpp"
#include "studies/program/study_file/export.hpp"
#include "studies/program/study_file/refusal.hpp"
#include "studies/report/pages/report_html.hpp"
#include "studies/report/record/results_file.hpp"

namespace dovetail::studies {
namespace {

namespace fs = std::filesystem;

/// A file of a run's directory. Throws InputError when it is not there.
fs::path run_file(const std::string& directory, const std::string& name, const std::string& what) {
  std::error_code ignored;
  fs::path file = fs::path(directory) / name;
  if (!fs::is_directory(directory, ignored)) refuse(directory, "is not the directory of a run");
  if (!fs::exists(file, ignored)) refuse(directory, "holds no " + what + " (" + name + ")");
  return file;
}

report::FieldRecord fields_of(const ExportOptions& options, bool of_run) {
  if (of_run) {
    const report::RunRecord record = report::read_results(run_file(options.input, "results.h5", "results"));
    if (record.best_design && record.best_design->fields.mesh.element_count() > 0) return record.best_design->fields;
    refuse(options.input, "holds no fields of a best design");
  }
  const Study study = load_study(options.input, overrides(options.set));
  const report::DesignRecord design = describe_fields(study);
  if (design.fields.mesh.element_count() > 0) return design.fields;
  refuse(options.input, "the design has no fields: " + design.status);
}

}  // namespace

int run_import(const ImportOptions& options, const Streams& streams) {
  const std::optional<reduction::ReducedModel> model = read_any_model(options.input);
  if (!model)
    refuse(options.input,
           "is not a reduced model: it does not say format = \"dovetail-reduced-model\"; of a study, `dovetail reduce` "
           "writes the model");
  reduction::write_model(options.model, *model);
  streams.out << fmt::format("{}: {} coordinates, {} contact nodes\n", options.model, model->size(),
                             model->contact.count());
  return kDone;
}

namespace {

int export_model(const ExportOptions& options, const std::string& input, const Streams& streams) {
  const LoadedModel loaded = load_model(input, options.set, {}, &streams.err);
  if (!loaded.failure.empty()) return not_converged(input, "not converged: " + loaded.failure, streams);
  write_model_document(options.file, loaded.model, options.input);
  streams.out << options.file << ": written, with three matrices beside it\n";
  return kDone;
}

}  // namespace

int run_export(const ExportOptions& options, const Streams& streams) {
  const std::optional<ExportFormat> format = named<ExportFormat>(options.format);
  const bool matrices = options.format == kMatrixMarket;
  if (!matrices && !format) {
    std::vector<std::string_view> formats = names_of<ExportFormat>();
    formats.push_back(kMatrixMarket);
    refuse("--format", one_of(formats), options.format);
  }
  if (format != ExportFormat::inp && options.deck != DeckOptions{})
    refuse("--format", "must be inp with --nodal-diameter, --modes or --contact", options.format);
  check_replaceable(options.file);
  const bool of_run = fs::is_directory(options.input);
  const auto design = [&] {
    return of_run ? run_file(options.input, "best.toml", "best design").string() : options.input;
  };
  if (matrices) return export_model(options, design(), streams);
  if (!of_run && (is_hdf5_file(options.input) || is_model_document(load_document(options.input))))
    refuse(options.input, "is a reduced model: it has matrices (--format matrix-market), no geometry");
  if (format == ExportFormat::vtu)
    export_fields(fields_of(options, of_run), options.file);
  else
    export_geometry(load_study(design(), overrides(options.set)).scene, *format, options.deck, options.file);
  streams.out << options.file << ": written\n";
  return kDone;
}

int run_report(const ReportOptions& options, const Streams& streams) {
  const report::RunRecord record = report::read_results(run_file(options.directory, "results.h5", "results"));
  report::write_report(options.file, record);
  streams.out << options.file << ": written\n";
  return kDone;
}

int run_merge(const MergeOptions& options, const Streams& streams) {
  const fs::path merged(options.directory);
  std::error_code error;
  if (fs::exists(merged, error) && !fs::is_empty(merged, error))
    refuse(options.directory, "exists already; choose another directory for the merged run");
  fs::create_directories(merged, error);
  if (error) refuse(options.directory, "cannot be created: " + error.message());
  std::size_t evaluations = 0;
  for (const std::string& name : {std::string("journal.jsonl"), std::string("finer.jsonl")}) {
    std::vector<fs::path> files;
    for (const std::string& directory : options.directories) files.push_back(run_file(directory, name, "journal"));
    const std::size_t records = optimizer::merge_journals(files, merged / name);
    evaluations = std::max(evaluations, records);
  }
  // What the first of them searched with.
  for (const char* name : {"study.toml", "settings.json"})
    if (const fs::path file = fs::path(options.directories.front()) / name; fs::exists(file, error))
      fs::copy_file(file, merged / name, error);
  streams.out << fmt::format("{}: {} different evaluations of {} runs\n", options.directory, evaluations,
                             options.directories.size());
  return kDone;
}

}  // namespace dovetail::studies
