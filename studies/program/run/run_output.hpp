#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "optimizer/accuracy/forecast.hpp"
#include "optimizer/search/run.hpp"
#include "optimizer/workers/worker_pool.hpp"
#include "studies/program/answers/teller.hpp"
#include "studies/program/engine/run_engine.hpp"
#include "studies/program/run/run_clock.hpp"

namespace dovetail::studies {

/// A run: what is computed, with what, and where it is kept and told.
struct RunSite {
  const Study& study;
  const RunEngine& engine;
  std::filesystem::path directory;
  Teller& teller;
  std::string settings = {};  ///< a sentence on those of start and best design where the search had others
  std::map<std::string, std::string> chosen = {};             ///< those that an accuracy chose, key -> value as text
  std::optional<optimizer::AccuracyGoal> goal = {};           ///< what is asked of start and best design
  std::map<std::size_t, optimizer::BarParts> raised = {};     ///< parts of bars of evaluations, by rounds of a choice
  optimizer::WorkerPool* pool = nullptr;                      ///< who works on pieces, if there are others
  std::function<void(const optimizer::Progress&)> told = {};  ///< of every candidate, if anybody listens
  bool describes = true;  ///< start and best design are looked at with bars, history and curves: not of a run cut short
};

/// Work on one design, beside a candidate of the search.
enum class Work { evaluate, bars, verify, describe };
/// How long so much of it takes, s, by what candidates took; 0 where nobody knows.
[[nodiscard]] double expected_s(const RunSite& site, const optimizer::OptimizationResult& result, Work what,
                                std::size_t count);

struct WrittenRun {
  report::RunRecord record;
  std::string inaccurate = {};  ///< what the best design misses of the accuracy asked for; empty: nothing
};

/// Writes what a run came to into its directory, finished or interrupted: best.toml and the exports the study asks for
/// (when there is a feasible design), results.h5 and report.html, and of a front its points. Each file whole or not at
/// all. The start and the best design are recorded as evaluations with bars and the wear history have them.
WrittenRun write_run(const RunSite& site, const optimizer::OptimizationResult& result, const RunClock& clock,
                     const std::vector<report::VerificationRecord>& verifications,
                     const std::vector<report::DepartureRecord>& departures);

/// The study's scene with the candidate's variables.
[[nodiscard]] optimizer::Scene scene_of(const Study& study, const optimizer::Candidate& candidate);

/// The variables' values of a candidate by key, file units.
[[nodiscard]] std::map<std::string, double> variable_values(const Study& study, const optimizer::Candidate& candidate);

}  // namespace dovetail::studies
