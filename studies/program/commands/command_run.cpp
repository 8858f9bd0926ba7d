#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <ostream>
#include <sstream>
#include <thread>

#include "core/replace_file.hpp"
#include "optimizer/journal/fingerprint.hpp"
#include "optimizer/journal/journal.hpp"
#include "optimizer/search/run.hpp"
#include "optimizer/workers/forked_pool.hpp"
#include "optimizer/workers/memory.hpp"
#include "studies/program/answers/run_departures.hpp"
#include "studies/program/answers/run_front.hpp"
#include "studies/program/answers/run_output.hpp"
#include "studies/program/answers/run_verification.hpp"
#include "studies/program/answers/version.hpp"
#include "studies/program/commands/commands.hpp"
#include "studies/program/commands/progress.hpp"
#include "studies/program/commands/settled_run.hpp"
#include "studies/program/engine/interrupt.hpp"
#include "studies/program/engine/pieces.hpp"
#include "studies/program/study_file/refusal.hpp"
#include "studies/report/words/report_words.hpp"

namespace dovetail::studies {
namespace {

namespace fs = std::filesystem;
using optimizer::OptimizationResult;

/// Edges of a mesh over those of another from which on one verifies the other: less and both may err alike.
constexpr double kFiner = 1.5;

void require_runnable(const Study& study) {
  Complaints wrong;
  for (const auto& [none, what] : {std::pair{study.problem.space.size() == 0, "variable"},
                                   std::pair{study.problem.objective.empty(), "objective"}})
    if (none) wrong.add(study.file, fmt::format("has no [[{}]]; an optimisation needs at least one", what));
  wrong.raise();
}

/// The part of the scan that was asked for; throws where there is none.
std::optional<optimizer::Part> part_of(const RunOptions& options, const Study& study) {
  if (options.part.empty()) return {};
  optimizer::Part part;
  std::istringstream text(options.part);
  char slash = 0;
  if (!(text >> part.number >> slash >> part.of) || slash != '/' || !text.eof() || part.number < 1 ||
      part.number > part.of)
    refuse("--part", "must be K/N, the K-th of N parts, as in 2/8", options.part);
  if (optimizer::scan_size(study.optimizer, study.problem.space.size()) == 0)
    refuse("--part", "is of the scan, and the study has none: give [optimizer] scan_evaluations", options.part);
  return part;
}

/// The directory of the results, created; an existing one is only touched to resume it. Scripts that always say
/// --resume begin where nothing is there, which whoever mistyped the directory hears.
fs::path prepare_directory(const RunOptions& options, const Study& study, std::ostream& err) {
  fs::path directory = options.directory.empty() ? fs::path("results") / study.name : fs::path(options.directory);
  std::error_code error;
  if (fs::exists(directory, error)) {
    if (!fs::is_directory(directory, error)) refuse(directory.string(), "is not a directory");
    if (!options.resume && !fs::is_empty(directory, error))
      refuse(directory.string(), "exists already; give --resume to continue the run in it or -o another directory");
  } else if (options.resume) {
    err << "dovetail: " << directory.string() << ": nothing is there to resume; a new run begins" << std::endl;
  }
  fs::create_directories(directory, error);
  if (error) refuse(directory.string(), "cannot be created: " + error.message());
  return directory;
}

std::string with_bar(double value, double bar, const char* unit = "") {
  return std::isfinite(bar) ? fmt::format("{:.4g} +- {:.2g}{}", value, bar, unit)
                            : fmt::format("{:.6g}{}", value, unit);
}

/// How far the best design stays from its limits, in per cent of them, here and on finer meshes.
std::string limits_kept(const report::RunRecord& record) {
  std::string text;
  const std::vector<std::string> names = constraint_names(record.problem);
  const report::EvaluationRecord& best = record.evaluations[*record.best];
  const optimizer::JudgementBars bars = judgement_bars(record.problem, best.responses, best.error_estimates);
  for (std::size_t j = 0; j < names.size(); ++j) {
    std::string finer;
    for (const report::FinerRecord& check : record.finer)
      if (check.evaluation == static_cast<std::int64_t>(*record.best))
        finer += fmt::format(", {:.3g} % on {} edges", -100 * check.constraints[j], check.flank_elements);
    const double room = -100 * best.constraints[j], bar = 100 * bars.constraints[j];
    text += fmt::format("  {} {} by {} of its limit{}{}\n", names[j], room < 0 ? "broken" : "kept",
                        with_bar(std::abs(room), bar, " %"), finer, std::abs(room) < bar ? ": undecided" : "");
  }
  return text;
}

std::string conclusion(const Study& study, const OptimizationResult& result, const report::RunRecord& record,
                       const fs::path& directory) {
  const optimizer::SearchStatistics& counts = result.statistics;
  const auto all = static_cast<int>(result.evaluations.size());
  const auto count = [&](const auto& of) { return static_cast<int>(std::ranges::count_if(result.evaluations, of)); };
  const int feasible = count([](const optimizer::Candidate& c) { return c.judgement.feasible; });
  const int failed =
      count([](const optimizer::Candidate& c) { return !c.evaluation.converged() && !c.evaluation.infeasible(); });
  std::string text = fmt::format(
      "{}: {} evaluations, {} of them stored before; {} feasible, {} break a limit or a rule, {} failed; {}\n",
      study.name, all, counts.replayed, feasible, all - feasible - failed, failed,
      result.message.empty() ? std::string(to_string(result.status)) : result.message);
  if (counts.unused_records > 0)
    text += fmt::format("{} stored evaluations were not asked for again: this search took another way\n",
                        counts.unused_records);
  if (!result.best) return text;
  const auto objective = [&](const report::EvaluationRecord& of) {
    return with_bar(of.objective, judgement_bars(record.problem, of.responses, of.error_estimates).objective);
  };
  if (record.front)
    text +=
        front_words(record) + fmt::format("compromise, nearest to the best of each: evaluation {}\n", *result.best + 1);
  else
    text += fmt::format("best objective {} (evaluation {}), start {}\n", objective(record.evaluations[*record.best]),
                        *result.best + 1, objective(record.evaluations.front()));
  for (const auto& [key, value] : variable_values(study, result.evaluations[*result.best]))
    text += fmt::format("  {} = {:.6g}\n", key, value);
  return text + limits_kept(record) + fmt::format("written to {}\n", directory.string());
}

std::string verified(const std::vector<report::VerificationRecord>& verifications) {
  std::string text;
  for (const report::VerificationRecord& v : verifications) {
    const auto known = [](bool is, double volume) { return is ? fmt::format("{:.6g} m^3", volume) : "not known"; };
    text += fmt::format("evaluation {}{} by its wear history: {}, directly {:.6g} m^3, on {} edges {} ({})\n",
                        v.evaluation + 1, v.load_case.empty() ? "" : " in case " + v.load_case,
                        known(v.history_known(), v.history_volume_m3), v.search_volume_m3, v.flank_elements,
                        known(v.finer_known(), v.direct_volume_m3), v.agreement());
  }
  return text;
}

/// Where else the best design keeps its limits.
std::string held(const report::RunRecord& record) {
  std::string broken;
  std::size_t all = 0, kept = 0;
  for (const report::DepartureRecord& there : record.departures) {
    if (!record.best || there.evaluation != static_cast<std::int64_t>(*record.best)) continue;
    ++all;
    const bool keeps =
        optimizer::converged(there.status) && std::ranges::all_of(there.constraints, [](double c) { return c <= 0; });
    kept += keeps ? 1 : 0;
    if (!keeps) broken += (broken.empty() ? "; not with " : ", ") + there.departure;
  }
  return all == 0 ? "" : fmt::format("keeps its limits in {} of {} other conditions{}\n", kept, all, broken);
}

/// "; none keeps A and B", or nothing.
std::string listed_unkept(const report::RunRecord& record) {
  const std::vector<std::string> never = report::never_kept(record);
  return never.empty() ? "" : fmt::format("; none keeps {}", fmt::join(never, ", nor "));
}

/// A rule that is broken at the start and at both ends of every variable by as much: a search would find nothing.
void refuse_hopeless(const Study& study, const RunEngine& engine) {
  if (!engine.rules) return;
  const std::vector<double> start = study.problem.space.start();
  std::map<std::string, geometry::Rule> broken;
  for (const geometry::Rule& rule : engine.rules(start))
    if (-rule.margin > study.optimizer.constraint_tolerance) broken.emplace(rule.name, rule);
  const std::vector<optimizer::DesignVariable>& variables = study.problem.space.variables();
  for (std::size_t i = 0; i < variables.size() && !broken.empty(); ++i)
    for (const double end : {variables[i].lower, variables[i].upper}) {
      std::vector<double> x = start;
      x[i] = end;
      std::vector<geometry::Rule> there;
      try {
        there = engine.rules(x);
      } catch (const InputError&) {
        // A linked key is out of its range there: no design, which breaks nothing alike.
      }
      std::erase_if(broken, [&](const auto& entry) {
        const auto same = std::ranges::find(there, entry.first, &geometry::Rule::name);
        return same == there.end() || same->margin != entry.second.margin;
      });
    }
  Complaints hopeless;
  for (const auto& [name, rule] : broken)
    hopeless.add(study.file, "no variable changes what the start breaks: " + rule.sentence);
  hopeless.raise();
}

/// What keeps the best design from being an answer, or nothing.
std::string shortcoming(const Study& study, const OptimizationResult& result, const WrittenRun& written) {
  const report::RunRecord& record = written.record;
  if (!result.best)
    return fmt::format("{}: no feasible design was found in {} evaluations{}", study.file, result.evaluations.size(),
                       listed_unkept(record));
  const bool stands = !record.best_design || optimizer::converged(record.best_design->status);
  if (!stands || !record.evaluations[*result.best].feasible)
    return fmt::format("the best design, evaluation {}, looked at with bars and its wear history: {}", *result.best + 1,
                       stands ? "breaks a limit" : record.best_design->status);
  for (const report::VerificationRecord& v : record.verifications)
    if (v.evaluation == static_cast<std::int64_t>(*result.best) && !optimizer::converged(v.status))
      return fmt::format("the verification of the best design, evaluation {}: {}", v.evaluation + 1, v.status);
  if (!written.inaccurate.empty())
    return fmt::format(
        "the best design, evaluation {}: {}{}", *result.best + 1, written.inaccurate,
        study.optimizer.verify_accuracy > 0
            ? ""
            : " (settings were chosen before the search; [optimizer] verify_accuracy has them chosen at the "
              "best design, too)");
  return {};
}

std::string fingerprint_of(const Study& study) {
  std::string physics = std::string("dovetail ") + version() + "\n" + physics_text(study.scene);
  for (const auto& [key, value] : study.linked) physics += key + " follows: " + value + "\n";
  return optimizer::fingerprint(study.problem, study.optimizer, physics);
}

/// On settings of start and best design that an accuracy chose; empty where they are those of the search.
std::string settings_words(const Study& searched, const SettledStudy& handed) {
  if (handed.accuracy.empty() || physics_text(searched.scene) == physics_text(handed.study.scene)) return {};
  const optimizer::SolverSettings& solver = handed.study.scene.solver;
  return fmt::format(
      "Computed with {} edges per flank, {} harmonics, {} samples, {} modes; the search had {}, {}, {} and {}.",
      handed.study.scene.mesh.flank_elements, solver.harmonics, solver.samples, solver.modes,
      searched.scene.mesh.flank_elements, searched.scene.solver.harmonics, searched.scene.solver.samples,
      searched.scene.solver.modes);
}

/// The search, with its journals in the directory.
OptimizationResult searched(const RunSite& site, bool resume, const std::optional<optimizer::Part>& part,
                            const std::string& fingerprint, const OrderlyInterrupt& interrupt) {
  const auto opened = [&](const char* name) {
    const fs::path file = site.directory / name;
    optimizer::Journal journal =
        resume ? optimizer::Journal::resume(file, fingerprint) : optimizer::Journal::create(file, fingerprint);
    if (!journal.note().empty()) site.err << "dovetail: " << journal.note() << "\n";
    return journal;
  };
  optimizer::Journal journal = opened("journal.jsonl"), finer_journal = opened("finer.jsonl");
  replace_file(site.directory / "study.toml", site.study.text);
  RunProgress progress(site.err, is_terminal(site.err), site.study.optimizer.max_evaluations, site.study.problem.front);
  optimizer::RunHooks hooks{.journal = &journal,
                            .progress =
                                [&](const optimizer::Progress& at) {
                                  progress(at);
                                  if (site.told) site.told(at);
                                },
                            .stop = &interrupt.flag(),
                            .finer = {},
                            .finer_journal = &finer_journal,
                            .part = part};
  hooks.many = site.engine.many;
  if (site.engine.finer)
    hooks.finer = [&](std::span<const double> x, int level) {
      progress.note(fmt::format("looking at the limits on a mesh with {} edges per flank",
                                site.study.scene.mesh.flank_elements << level));
      return site.engine.finer(x, level);
    };
  return optimizer::run_optimization(site.study.problem, site.engine.evaluate, site.study.optimizer, hooks);
}

}  // namespace

std::unique_ptr<optimizer::WorkerPool> processes(const RunOptions& options, const optimizer::WorkerFactory& factory) {
  const auto jobs =
      static_cast<std::size_t>(options.jobs.value_or(static_cast<int>(std::thread::hardware_concurrency())));
  if (jobs <= 1) return nullptr;
  // Whoever gives a number knows what there is.
  return std::make_unique<optimizer::ForkedPool>(jobs, factory, options.patience,
                                                 options.jobs ? optimizer::FreeMemory() : optimizer::free_memory);
}

int run_study(const RunOptions& options, const Streams& streams, const RunEngineFactory& make_engine,
              const PoolFactory& pools) {
  return run_study(load_study(options.study), options, streams, make_engine, pools);
}

int run_study(const Study& asked, const RunOptions& options, const Streams& streams,
              const RunEngineFactory& make_engine, const PoolFactory& pools,
              const std::function<void(const optimizer::Progress&)>& told) {
  const auto begin = std::chrono::steady_clock::now();
  require_runnable(asked);
  const std::optional<optimizer::Part> part = part_of(options, asked);
  for (const std::string& warning : warnings(asked)) streams.err << options.study << ": warning: " << warning << "\n";
  const fs::path directory = prepare_directory(options, asked, streams.err);
  const SettledStudy settled = settled_run(asked, directory, options.resume, make_engine, streams.err);
  const Study& study = settled.study;
  const std::unique_ptr<optimizer::WorkerPool> pool = pools(options, workers_with(make_engine));
  const RunEngine alone = make_engine(study);
  refuse_hopeless(study, alone);
  if (pool) pool->prepare(description_of(study));
  const RunEngine engine = pool ? at_work(study, alone, *pool) : alone;
  const RunSite site{
      .study = study, .engine = engine, .directory = directory, .err = streams.err, .pool = pool.get(), .told = told};
  const OrderlyInterrupt interrupt;
  OptimizationResult result = searched(site, options.resume, part, fingerprint_of(study), interrupt);
  if (part) {
    streams.out << fmt::format("{}: part {} of {} of the scan, {} evaluations in {}\n", study.name, part->number,
                               part->of, result.evaluations.size(), directory.string());
    return interrupt.requested() ? kInterrupted : kDone;
  }
  add_front_bars(site, fingerprint_of(study), interrupt, result);

  // What is handed over may ask for more than the search.
  const bool settles = result.best && !interrupt.requested();
  const SettledStudy over = settles ? settled_best(asked, study, result.evaluations[*result.best], directory,
                                                   options.resume, interrupt, streams.err)
                                    : SettledStudy{.study = study};
  const Study& handed = over.study;
  const std::string settings = settings_words(study, over);
  const bool as_searched = physics_text(study.scene) == physics_text(handed.scene);
  const RunEngine handing = as_searched ? alone : make_engine(handed);
  const RunEngine closer = pool ? at_work(handed, handing, *pool) : handing;
  // What the rounds of a choice say of the design where it was made holds for its evaluation there.
  std::map<std::size_t, optimizer::BarParts> raised;
  if (as_searched) raised[0] = settled.raised;
  if (!over.raised.empty()) raised[*result.best] = over.raised;
  const RunSite end{.study = handed,
                    .engine = closer,
                    .directory = directory,
                    .err = streams.err,
                    .settings = settings,
                    .chosen = chosen_settings(asked, settled, over),
                    .goal = goal_at_best(asked),
                    .raised = raised,
                    .pool = pool.get()};
  std::vector<report::VerificationRecord> verifications;
  // Settings that are handed over verify those of the search where they are finer.
  const bool finer = handed.scene.mesh.flank_elements >= kFiner * study.scene.mesh.flank_elements;
  if (!interrupt.requested())
    verifications = verify_best(finer ? site : end, result, finer ? &handed : nullptr,
                                fingerprint_of(study) + fingerprint_of(handed), interrupt);

  const std::vector<report::DepartureRecord> departures = departures_of(end, result, fingerprint_of(handed), interrupt);

  if (pool) pool->prepare(description_of(handed));  // who has nothing left to do gives his memory back

  if (interrupt.requested())
    streams.err << "dovetail: interrupted; writing what is finished (Ctrl-C again ends at once)" << std::endl;
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const WrittenRun written = write_run(end, result, seconds, verifications, departures);
  streams.out << conclusion(study, result, written.record, site.directory) << verified(verifications)
              << held(written.record);
  if (interrupt.requested()) {
    streams.err << "dovetail: everything finished is kept; go on with --resume\n";
    return kInterrupted;
  }
  if (const std::string open = shortcoming(study, result, written); !open.empty()) {
    streams.err << "dovetail: " << open << "\n";
    return kNotConverged;
  }
  return result.status == Status::converged || result.status == Status::iteration_limit ? kDone : kNotConverged;
}

}  // namespace dovetail::studies
