#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <ostream>
#include <set>
#include <sstream>
#include <thread>

#include "core/replace_file.hpp"
#include "optimizer/journal/fingerprint.hpp"
#include "optimizer/journal/journal.hpp"
#include "optimizer/search/run.hpp"
#include "optimizer/workers/forked_pool.hpp"
#include "optimizer/workers/memory.hpp"
#include "studies/program/answers/version.hpp"
#include "studies/program/commands/commands.hpp"
#include "studies/program/commands/settled_run.hpp"
#include "studies/program/commands/told.hpp"
#include "studies/program/engine/interrupt.hpp"
#include "studies/program/engine/json_values.hpp"
#include "studies/program/engine/loaded_model.hpp"
#include "studies/program/engine/pieces.hpp"
#include "studies/program/run/finished_run.hpp"
#include "studies/program/run/run_clock.hpp"
#include "studies/program/run/run_departures.hpp"
#include "studies/program/run/run_front.hpp"
#include "studies/program/run/run_output.hpp"
#include "studies/program/run/run_verification.hpp"
#include "studies/program/run/run_words.hpp"
#include "studies/program/run/search_progress.hpp"
#include "studies/program/study_file/best_file.hpp"
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

/// The directory of the results.
fs::path directory_of(const RunOptions& options, const Study& study) {
  return options.directory.empty() ? fs::path("results") / study.name : fs::path(options.directory);
}

/// The same, created; an existing one is only touched to resume it. Scripts that always say
/// --resume begin where nothing is there, which whoever mistyped the directory hears.
fs::path prepare_directory(const RunOptions& options, const Study& study, std::ostream& err) {
  fs::path directory = directory_of(options, study);
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
  std::set<std::string_view> told;  // a rule in one of the cases is enough
  for (const auto& [name, rule] : broken)
    if (told.insert(optimizer::split_case(name).response).second)
      hopeless.add(study.file, "no variable changes what the start breaks: " + rule.sentence);
  hopeless.raise();
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

struct Searched {
  OptimizationResult result;
  bool late = false;  ///< the time of the run was over before it ended
};

/// The search, with its journals in the directory.
Searched searched(const RunSite& site, RunClock& clock, bool resume, const std::optional<optimizer::Part>& part,
                  const std::string& fingerprint, const OrderlyInterrupt& interrupt) {
  if (const fs::path before = site.directory / "journal.jsonl"; resume && fs::exists(before)) {
    const optimizer::JournalContents kept = optimizer::read_journal(before);
    if (!kept.fingerprint.empty() && kept.fingerprint != fingerprint) refuse_changed(site.directory, site.study);
    refuse_fewer(site.directory, site.study, kept.records.size());
  }
  const auto opened = [&](const char* name) {
    const fs::path file = site.directory / name;
    optimizer::Journal journal =
        resume ? optimizer::Journal::resume(file, fingerprint) : optimizer::Journal::create(file, fingerprint);
    if (!journal.note().empty()) site.teller.remark() << "dovetail: " << journal.note() << "\n";
    return journal;
  };
  optimizer::Journal journal = opened("journal.jsonl"), finer_journal = opened("finer.jsonl");
  forget_finished(site.directory);
  clock.counts();
  replace_file(site.directory / "study.toml", site.study.text);
  SearchProgress progress(site.teller, site.study.problem, site.study.optimizer.max_evaluations,
                          site.directory.string(), site.pool != nullptr);
  const double limit = site.study.optimizer.time_limit;
  bool late = false;
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
  if (limit > 0) hooks.time_over = [&] { return late = late || clock.session() >= limit; };
  hooks.many = site.engine.many;
  if (site.engine.finer)
    hooks.finer = [&](std::span<const double> x, int level) {
      const int edges = site.study.scene.mesh.flank_elements << level;
      site.teller.event("finer", {{"flank_elements", edges}});
      site.teller.status(
          [edges](double seconds) {
            return fmt::format("looking at the limits on a mesh with {} edges per flank", edges) +
                   (seconds < 1 ? "" : ": " + time_words(seconds));
          },
          fmt::format("the look at a mesh with {} edges per flank", edges));
      return site.engine.finer(x, level);
    };
  OptimizationResult result =
      optimizer::run_optimization(site.study.problem, site.engine.evaluate, site.study.optimizer, hooks);
  if (late && !interrupt.requested())
    result.message = fmt::format("optimizer.time_limit_s = {:g} is over; --resume goes on", limit);
  site.teller.end();
  return {.result = std::move(result), .late = late};
}

/// Everything a run is about: the same once more has nothing to do.
std::string question_of(const Study& study) {
  return optimizer::fingerprint(study.problem, study.optimizer, std::string(version()) + "\n" + study.text);
}

/// A part of a scan is over, or interrupted.
std::string part_words(const Study& study, const optimizer::Part& part, std::size_t done, const fs::path& directory,
                       bool interrupted, bool late) {
  const int all = optimizer::scan_size(study.optimizer, study.problem.space.size());
  const int own = 1 + (all - part.number + part.of) / part.of;  // with the start
  if (interrupted || late)
    return fmt::format("{}: {} in part {} of {} of the scan: {} of its {} evaluations are kept in {}\n", study.name,
                       interrupted ? "interrupted" : "the time is over", part.number, part.of, done, own,
                       directory.string());
  return fmt::format("{}: part {} of {} of the scan, {} in {}\n", study.name, part.number, part.of,
                     report::counted(done, "evaluation"), directory.string());
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

namespace {

/// A run from its settings to what it hands over.
int computed(const RunOptions& options, const Study& asked, const fs::path& directory, const Streams& streams,
             Teller& teller, const RunEngineFactory& make_engine, const PoolFactory& pools,
             const std::function<void(const optimizer::Progress&)>& told) {
  RunClock clock(directory, options.resume);
  const std::optional<optimizer::Part> part = part_of(options, asked);
  teller.keeps("what is finished is kept in " + directory.string() + "; the same command with --resume goes on");
  const SettledStudy settled = settled_run(asked, directory, options.resume, make_engine, teller);
  const Study& study = settled.study;
  const std::unique_ptr<optimizer::WorkerPool> pool = pools(options, workers_with(make_engine));
  teller.begin("meshing the reference design");
  const RunEngine alone = make_engine(study);
  refuse_hopeless(study, alone);
  if (pool) pool->prepare(description_of(study));
  const RunEngine engine = pool ? at_work(study, alone, *pool) : alone;
  const RunSite site{
      .study = study, .engine = engine, .directory = directory, .teller = teller, .pool = pool.get(), .told = told};
  const OrderlyInterrupt interrupt;
  auto [result, late] = searched(site, clock, options.resume, part, fingerprint_of(study), interrupt);
  if (part) {
    streams.out << part_words(study, *part, result.evaluations.size(), directory, interrupt.requested(), late);
    if (!interrupt.requested() && !late) return kDone;
    streams.err << "dovetail: the same command with --resume goes on with this part\n";
    return interrupt.requested() ? kInterrupted : kDone;
  }
  add_front_bars(site, fingerprint_of(study), interrupt, result);

  // What is handed over may ask for more than the search.
  const bool settles = result.best && !interrupt.requested();
  const SettledStudy over = settles ? settled_best(asked, study, result.evaluations[*result.best], directory,
                                                   options.resume, interrupt, teller)
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
  RunSite end{.study = handed,
              .engine = closer,
              .directory = directory,
              .teller = teller,
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

  // From here on everything is computed and written: Ctrl-C comes too late to leave something out.
  const bool interrupted = interrupt.requested();
  end.describes = !interrupted;
  const WrittenRun written = write_run(end, result, clock, verifications, departures);
  teller.end();
  const std::string answer =
      conclusion(study, result, written.record, directory) + verified_words(verifications) + held_words(written.record);
  streams.out << answer;
  if (interrupted) {
    streams.err << fmt::format("dovetail: interrupted; {} kept in {}; the same command with --resume goes on\n",
                               report::counted(result.evaluations.size(), "evaluation"), directory.string());
    return kInterrupted;
  }
  if (const std::string open = shortcoming(study, result, written); !open.empty()) {
    streams.err << "dovetail: " << open << "\n";
    return kNotConverged;
  }
  if (result.status != Status::converged && result.status != Status::iteration_limit) return kNotConverged;
  // What was lost with a process is asked again.
  const auto lost = [](const auto& one) { return optimizer::lost_with_its_process(one.status); };
  const auto lost_look = [&](const auto& one) { return lost(one.evaluation); };
  if (!late && std::ranges::none_of(result.evaluations, lost_look) && std::ranges::none_of(result.finer, lost_look) &&
      std::ranges::none_of(verifications, lost) && std::ranges::none_of(departures, lost))
    keep_finished(directory, question_of(asked), answer);
  return kDone;
}

}  // namespace

int run_study(const RunOptions& options, const Streams& streams, const RunEngineFactory& make_engine,
              const PoolFactory& pools) {
  Study asked;
  try {
    asked = load_rewritten_study(options.study, overrides(options.set));
  } catch (const InputError&) {
    const ToldCommand refused{.name = "run", .fields = {{"study", options.study}}};
    return told(refused, options.tell, streams, [](Teller&) -> int { throw; });
  }
  return run_study(asked, options, streams, make_engine, pools);
}

int run_study(const Study& asked, const RunOptions& options, const Streams& streams,
              const RunEngineFactory& make_engine, const PoolFactory& pools,
              const std::function<void(const optimizer::Progress&)>& told) {
  const ToldCommand command{.name = "run",
                            .plain = true,
                            .fields = {{"study", options.study},
                                       {"directory", directory_of(options, asked).string()},
                                       {"max_evaluations", asked.optimizer.max_evaluations}}};
  return studies::told(command, options.tell, streams, [&](Teller& teller) {
    require_runnable(asked);
    static_cast<void>(part_of(options, asked));
    for (const std::string& warning : warnings(asked))
      teller.remark() << options.study << ": warning: " << warning << "\n";
    const fs::path directory = prepare_directory(options, asked, teller.remark());
    if (options.resume && options.part.empty())
      if (const std::optional<std::string> before = finished_before(directory, question_of(asked))) {
        teller.remark() << "dovetail: " << directory.string() << ": this run is finished; nothing is computed again\n";
        streams.out << *before;
        return static_cast<int>(kDone);
      }
    return computed(options, asked, directory, streams, teller, make_engine, pools, told);
  });
}

}  // namespace dovetail::studies
