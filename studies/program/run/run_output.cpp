#include "studies/program/run/run_output.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <future>
#include <optional>
#include <ostream>
#include <utility>

#include "core/replace_file.hpp"
#include "optimizer/evaluation_cost.hpp"
#include "optimizer/scene/scene_kind.hpp"
#include "optimizer/workers/memory.hpp"
#include "studies/program/answers/field_export.hpp"
#include "studies/program/answers/geometry_export.hpp"
#include "studies/program/answers/version.hpp"
#include "studies/program/engine/engine.hpp"
#include "studies/program/engine/settled_study.hpp"
#include "studies/program/run/candidate_table.hpp"
#include "studies/program/run/run_front.hpp"
#include "studies/program/study_file/best_file.hpp"
#include "studies/program/study_file/export.hpp"
#include "studies/report/pages/report_html.hpp"
#include "studies/report/record/results_file.hpp"

namespace dovetail::studies {

using optimizer::OptimizationResult;
using optimizer::Scene;

std::map<std::string, double> variable_values(const Study& study, const optimizer::Candidate& candidate) {
  return settings_at(study, candidate.x);
}

Scene scene_of(const Study& study, const optimizer::Candidate& candidate) {
  return scene_at(study, candidate.x);
}

namespace {

std::string sentence(std::string words) {
  words.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(words.front())));
  return words + ".";
}

/// What the closer look says of a candidate. A search takes the direct worn state and no bars.
void take_over(const Study& study, optimizer::Evaluation seen, optimizer::Candidate& candidate) {
  const double tolerance = study.optimizer.constraint_tolerance, before = candidate.judgement.objective;
  annotate(study.problem, tolerance, seen);
  optimizer::Judgement now = judge(study.problem, seen, tolerance);
  if (!now.computed) {
    candidate.evaluation.error_estimates = seen.error_estimates;
    candidate.evaluation.messages = seen.messages;
    candidate.evaluation.messages.push_back("Looked at more closely it ends with \"" + seen.status +
                                            "\"; its values are those of the search.");
    return;
  }
  if (now.objective != before)
    seen.messages.push_back(
        fmt::format("The search, which takes the direct worn state and its own settings, had an objective of {:.4g}, "
                    "now {:.4g}.",
                    before, now.objective));
  // What the search refused by its limits on finer meshes stays refused.
  if (!candidate.judgement.feasible) {
    now.feasible = false;
    now.violation = std::max(now.violation, candidate.judgement.violation);
  }
  candidate.evaluation = std::move(seen);
  candidate.judgement = now;
}

}  // namespace

double expected_s(const RunSite& site, const OptimizationResult& result, Work what, std::size_t count) {
  double seconds = 0;
  int timed = 0;
  for (const optimizer::Candidate& candidate : result.evaluations)
    if (const auto total = candidate.evaluation.timings_s.find("total");
        total != candidate.evaluation.timings_s.end()) {
      seconds += total->second;
      ++timed;
    }
  if (timed == 0 || count == 0) return 0;
  const optimizer::WorkParams work = optimizer::work_foreseen(site.study.scene.kind->in_space);
  const double times = what == Work::evaluate ? 1
                       : what == Work::bars   ? work.bars
                       : what == Work::verify ? work.verify
                                              : work.describe;
  const std::size_t at_once = site.pool != nullptr ? site.pool->size() : 1;
  const std::size_t turns = (count + at_once - 1) / at_once;
  return seconds / timed * times * static_cast<double>(turns);
}

namespace {

WrittenRun record_of(const RunSite& site, OptimizationResult result, const RunClock& clock) {
  const Study& study = site.study;
  const RunEngine& engine = site.engine;
  std::optional<report::DesignRecord> best, baseline;
  std::string inaccurate;
  const bool start_is_best = result.best == std::size_t{0};
  // Both are begun before either is waited for: where others work for a run, start and best design are described at
  // once.
  const auto described = [&](std::size_t index) {
    const optimizer::MemoryTaken taken = optimizer::memory_taken(::getpid());
    const bool fit = optimizer::processes_that_fit(taken.most, taken.now, optimizer::free_memory()) > 1;
    const bool at_once = site.pool != nullptr && site.pool->size() > 1 && fit && result.best && !start_is_best;
    return std::async(at_once ? std::launch::async : std::launch::deferred,
                      [&, index] { return engine.describe(scene_of(study, result.evaluations[index])); });
  };
  const auto look = [&](std::size_t index, std::future<DescribedDesign> future,
                        std::optional<report::DesignRecord>& design) {
    DescribedDesign seen = future.get();
    optimizer::Candidate& candidate = result.evaluations[index];
    if (const auto raised = site.raised.find(index); raised != site.raised.end())
      optimizer::raise_bars(raised->second, seen.evaluation);
    take_over(study, std::move(seen.evaluation), candidate);
    if (site.goal) {
      const AccuracyHeld held = accuracy_held(study.problem, study.scene, *site.goal, candidate.evaluation);
      candidate.evaluation.messages.push_back(sentence(held.words));
      if (index == result.best && !held.reached) inaccurate = held.words;
    }
    if (!site.settings.empty()) candidate.evaluation.messages.push_back(site.settings);
    design = std::move(seen.record);
    const std::vector<std::string>& messages = candidate.evaluation.messages;
    design->notes.insert(design->notes.begin(), messages.begin(), messages.end());
  };
  std::future<DescribedDesign> of_best, of_start;
  const bool describes = engine.describe && site.describes;
  if (describes && result.best) of_best = described(*result.best);
  if (describes && !result.evaluations.empty() && !start_is_best) of_start = described(0);
  if (of_best.valid()) look(*result.best, std::move(of_best), best);
  if (of_start.valid())
    look(0, std::move(of_start), baseline);
  else
    baseline = best;
  report::RunRecord record = report::record_run(study.problem, study.optimizer, result);
  record.name = study.name;
  record.title = study.title;
  record.wear_law = study.scene.contact.wear_law;
  record.seconds = clock.total();
  record.provenance.program_version = version();
  record.provenance.study_file = study.file;
  record.provenance.settings = site.chosen;
  for (const LinkedKey& linked : study.linked) record.provenance.linked[linked.key] = linked.value;
  record.provenance.study_text = study.text;
  record.best_design = std::move(best);
  record.baseline_design = std::move(baseline);
  return {.record = std::move(record), .inaccurate = std::move(inaccurate)};
}

}  // namespace

WrittenRun write_run(const RunSite& site, const OptimizationResult& result, const RunClock& clock,
                     const std::vector<report::VerificationRecord>& verifications,
                     const std::vector<report::DepartureRecord>& departures) {
  const Study& study = site.study;
  // The design first: it costs nothing and must not be lost when describing it is cut short.
  if (result.best) {
    const optimizer::Candidate& best = result.evaluations[*result.best];
    replace_file(site.directory / "best.toml",
                 with_values(parse_document(study.text, study.file), variable_values(study, best)));
  }
  if (site.describes && site.engine.describe)
    site.teller.begin("describing start and best design", expected_s(site, result, Work::describe, 2));
  WrittenRun written = record_of(site, result, clock);
  site.teller.begin("writing results and report");
  report::RunRecord& record = written.record;
  if (result.front) record.front = front_record(study.problem, result);
  if (study.problem.front) write_front(site.directory, study, result);
  record.verifications = verifications;
  record.departures = departures;
  report::write_results(site.directory / "results.h5", record);
  report::write_report(site.directory / "report.html", record);
  if (!result.best) return written;
  const Scene best = scene_of(study, result.evaluations[*result.best]);
  for (const ExportFormat format : study.exports) {
    const std::filesystem::path file = site.directory / ("best." + std::string(to_string(format)));
    const bool fields = record.best_design && record.best_design->fields.mesh.element_count() > 0;
    try {
      if (format == ExportFormat::csv)
        replace_file(site.directory / "candidates.csv", candidate_table(record));
      else if (!has_fields(format))
        export_geometry(best, format, {}, file);
      else if (!fields || (format == ExportFormat::pvd && !record.best_design->history))
        site.teller.remark() << "dovetail: " << file.string() << ": not written: the best design has no "
                             << (fields ? "wear history" : "fields") << "\n";
      else
        (format == ExportFormat::pvd ? export_history : export_fields)(*record.best_design, file);
    } catch (const InputError& error) {
      // The run is over, and what it found is written.
      site.teller.remark() << "dovetail: " << file.string() << ": not written: " << error.what() << "\n";
    }
  }
  return written;
}

}  // namespace dovetail::studies
