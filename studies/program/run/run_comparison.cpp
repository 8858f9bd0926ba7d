#include "studies/program/run/run_comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "optimizer/journal/journal.hpp"
#include "studies/program/answers/version.hpp"
#include "studies/program/engine/json_values.hpp"
#include "studies/program/run/candidate_table.hpp"
#include "studies/program/run/run_clock.hpp"
#include "studies/program/study_file/refusal.hpp"
#include "studies/program/study_file/study.hpp"
#include "studies/report/record/results_file.hpp"

namespace dovetail::studies {
namespace {

namespace fs = std::filesystem;

bool is_run(const fs::path& directory) {
  std::error_code ignored;
  return fs::exists(directory / "results.h5", ignored) ||
         (fs::exists(directory / "journal.jsonl", ignored) && fs::exists(directory / "study.toml", ignored));
}

std::optional<double> known(double value) {
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

ComparedRun finished(const fs::path& directory) {
  const report::RunRecord record = report::read_results(directory / "results.h5");
  ComparedRun run{.directory = directory.string(),
                  .name = record.name,
                  .status = record.status,
                  .evaluations = static_cast<int>(record.evaluations.size()),
                  .best = {},
                  .objective = {},
                  .start = {},
                  .seconds = record.seconds};
  for (const report::EvaluationRecord& at : record.evaluations) {
    run.feasible += at.feasible ? 1 : 0;
    run.failed +=
        !optimizer::converged(at.status) && optimizer::outcome_of(at.status) != optimizer::Outcome::infeasible;
  }
  if (!record.evaluations.empty()) run.start = known(record.evaluations.front().objective);
  if (!record.best) return run;
  const report::EvaluationRecord& best = record.evaluations[*record.best];
  run.best = static_cast<int>(*record.best) + 1;
  run.objective = known(best.objective);
  run.responses = best.responses;
  run.variables = record.problem.space.settings(best.x);
  return run;
}

/// Of one that was cut off, or is still under way: what its journal has.
ComparedRun unfinished(const fs::path& directory) {
  const Study study = load_study((directory / "study.toml").string());
  ComparedRun run{.directory = directory.string(),
                  .name = study.name,
                  .status = "unfinished",
                  .best = {},
                  .objective = {},
                  .start = {},
                  .seconds = seconds_taken(directory)};
  std::optional<optimizer::Judgement> best;
  for (const optimizer::JournalRecord& record : optimizer::read_journal(directory / "journal.jsonl").records) {
    const optimizer::Judgement judgement =
        judge(study.problem, record.evaluation, study.optimizer.constraint_tolerance);
    ++run.evaluations;
    run.feasible += judgement.feasible ? 1 : 0;
    run.failed += !judgement.computed && !record.evaluation.infeasible() ? 1 : 0;
    if (run.evaluations == 1) run.start = known(judgement.objective);
    if (!judgement.feasible || (best && !optimizer::better(judgement, *best))) continue;
    best = judgement;
    run.best = run.evaluations;
    run.objective = known(judgement.objective);
    run.responses = record.evaluation.responses;
    run.variables = study.problem.space.settings(record.x);
  }
  return run;
}

template <class Member>
std::vector<std::string> all_names(const std::vector<ComparedRun>& runs, Member member) {
  std::set<std::string> names;
  for (const ComparedRun& run : runs)
    for (const auto& [name, value] : run.*member) names.insert(name);
  return {names.begin(), names.end()};
}

std::string cell(const std::map<std::string, double>& values, const std::string& name) {
  const auto found = values.find(name);
  return found == values.end() ? std::string() : table_number(found->second);
}

}  // namespace

std::vector<fs::path> runs_in(const std::string& directory) {
  std::error_code error;
  if (!fs::is_directory(directory, error)) refuse(directory, "is not a directory");
  if (is_run(directory)) return {directory};
  std::vector<fs::path> runs;
  for (const fs::directory_entry& entry : fs::directory_iterator(directory, error))
    if (entry.is_directory(error) && is_run(entry.path())) runs.push_back(entry.path());
  if (error) refuse(directory, "cannot be read: " + error.message());
  if (runs.empty())
    refuse(directory, "holds no run: neither it nor a directory in it has a journal.jsonl or results.h5");
  std::ranges::sort(runs);
  return runs;
}

ComparedRun compared(const fs::path& directory) {
  try {
    return fs::exists(directory / "results.h5") ? finished(directory) : unfinished(directory);
  } catch (const InputError&) {
    return {.directory = directory.string(), .name = {}, .status = "damaged", .best = {}, .objective = {}, .start = {}};
  }
}

std::string comparison_table(const std::vector<ComparedRun>& runs) {
  std::size_t width = 9;
  for (const ComparedRun& run : runs) width = std::max(width, run.directory.size());
  const auto number = [](const std::optional<double>& value) {
    return value ? fmt::format("{:.6g}", *value) : std::string("-");
  };
  std::string text = fmt::format("{:>3}  {:<{}}  {:<15} {:>11} {:>8} {:>6} {:>5} {:>13} {:>13}\n", "", "directory",
                                 width, "status", "evaluations", "feasible", "failed", "best", "objective", "start");
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const ComparedRun& run = runs[i];
    text += fmt::format("{:>3}  {:<{}}  {:<15} {:>11} {:>8} {:>6} {:>5} {:>13} {:>13}\n", i + 1, run.directory, width,
                        run.status, run.evaluations, run.feasible, run.failed,
                        run.best ? std::to_string(*run.best) : "-", number(run.objective), number(run.start));
  }
  const std::vector<std::string> keys = all_names(runs, &ComparedRun::variables);
  if (keys.empty()) return text;
  text += fmt::format("\n{:<40}", "best values");
  for (std::size_t i = 0; i < runs.size(); ++i) text += fmt::format(" {:>12}", i + 1);
  for (const std::string& key : keys) {
    text += fmt::format("\n{:<40}", key);
    for (const ComparedRun& run : runs) {
      const auto found = run.variables.find(key);
      text += fmt::format(" {:>12}", number(found == run.variables.end() ? std::nullopt : known(found->second)));
    }
  }
  return text + "\n";
}

std::string comparison_csv(const std::vector<ComparedRun>& runs) {
  const auto number = [](const std::optional<double>& value) { return value ? table_number(*value) : std::string(); };
  const std::vector<std::string> keys = all_names(runs, &ComparedRun::variables),
                                 responses = all_names(runs, &ComparedRun::responses);
  std::string text = "directory,name,status,evaluations,feasible,failed,best,objective,start,seconds";
  for (const auto* names : {&keys, &responses})
    for (const std::string& name : *names) text += "," + csv_cell(name);
  text += "\n";
  for (const ComparedRun& run : runs) {
    text +=
        fmt::format("{},{},{},{},{},{},{},{},{},{}", csv_cell(run.directory), csv_cell(run.name), csv_cell(run.status),
                    run.evaluations, run.feasible, run.failed, run.best ? std::to_string(*run.best) : "",
                    number(run.objective), number(run.start), table_number(run.seconds));
    for (const std::string& key : keys) text += "," + cell(run.variables, key);
    for (const std::string& name : responses) text += "," + cell(run.responses, name);
    text += "\n";
  }
  return text;
}

std::string comparison_json(const std::vector<ComparedRun>& runs) {
  Json list = Json::array();
  for (const ComparedRun& run : runs)
    list.push_back({{"directory", run.directory},
                    {"name", run.name},
                    {"status", run.status},
                    {"evaluations", run.evaluations},
                    {"feasible", run.feasible},
                    {"failed", run.failed},
                    {"best", run.best ? Json(*run.best) : Json()},
                    {"objective", run.objective ? Json(*run.objective) : Json()},
                    {"start", run.start ? Json(*run.start) : Json()},
                    {"variables", json_of(run.variables)},
                    {"responses", json_of(run.responses)},
                    {"seconds", run.seconds}});
  return text({{"version", kAnswerVersion}, {"runs", list}});
}

}  // namespace dovetail::studies
