#include "studies/program/run_output.hpp"

#include <optional>
#include <ostream>
#include <utility>

#include "core/replace_file.hpp"
#include "studies/program/best_file.hpp"
#include "studies/program/deck_export.hpp"
#include "studies/program/export.hpp"
#include "studies/program/field_export.hpp"
#include "studies/program/version.hpp"
#include "studies/report/report_html.hpp"
#include "studies/report/results_file.hpp"

namespace dovetail::studies {

using optimizer::OptimizationResult;
using optimizer::Scene;

std::map<std::string, double> variable_values(const Study& study, const optimizer::Candidate& candidate) {
  std::map<std::string, double> values;
  const std::vector<std::string> keys = study.problem.space.keys();
  for (std::size_t i = 0; i < keys.size(); ++i) values[keys[i]] = candidate.x[i];
  return values;
}

Scene scene_of(const Study& study, const optimizer::Candidate& candidate) {
  Scene scene = study.scene;
  for (const auto& [key, value] : variable_values(study, candidate)) optimizer::set_parameter(scene, key, value);
  return scene;
}

namespace {

report::RunRecord record_of(const Study& study, const OptimizationResult& result, const RunEngine& engine,
                            double seconds) {
  report::RunRecord record = report::record_run(study.problem, study.optimizer, result);
  record.name = study.name;
  record.title = study.title;
  record.seconds = seconds;
  record.provenance.program_version = version();
  record.provenance.study_file = study.file;
  record.provenance.study_text = study.text;
  if (!engine.describe) return record;
  if (result.best) record.best_design = engine.describe(scene_of(study, result.evaluations[*result.best]));
  if (record.baseline) record.baseline_design = engine.describe(scene_of(study, result.evaluations[*record.baseline]));
  // A search computes no bars; those of the designs described are those of their evaluations.
  for (const auto& [index, design] :
       {std::pair{result.best, &record.best_design}, std::pair{record.baseline, &record.baseline_design}})
    if (index && *design) record.evaluations[*index].error_estimates = (*design)->error_estimates;
  return record;
}

}  // namespace

void write_run(const Study& study, const OptimizationResult& result, const RunEngine& engine, double seconds,
               const std::vector<report::VerificationRecord>& verifications, const std::filesystem::path& directory,
               std::ostream& err) {
  // The design first: it costs nothing and must not be lost when describing it is cut short.
  if (result.best) {
    const optimizer::Candidate& best = result.evaluations[*result.best];
    replace_file(directory / "best.toml",
                 with_values(parse_document(study.text, study.file), variable_values(study, best)));
  }
  report::RunRecord record = record_of(study, result, engine, seconds);
  record.verifications = verifications;
  report::write_results(directory / "results.h5", record);
  report::write_report(directory / "report.html", record);
  if (!result.best) return;
  const Scene best = scene_of(study, result.evaluations[*result.best]);
  for (const std::string& format : study.exports) {
    const std::filesystem::path file = directory / ("best." + format);
    if (is_deck_format(format))
      export_deck(best, {}, file);
    else if (!is_field_format(format))
      export_section(best, format, file);
    else if (record.best_design && record.best_design->fields.mesh.element_count() > 0)
      export_fields(record.best_design->fields, file);
    else
      err << "dovetail: " << file.string() << ": not written: the best design has no fields\n";
  }
}

}  // namespace dovetail::studies
