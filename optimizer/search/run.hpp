#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/status.hpp"
#include "optimizer/journal/journal.hpp"
#include "optimizer/problem/optimizer_options.hpp"
#include "optimizer/problem/problem.hpp"
#include "optimizer/search/front.hpp"

namespace dovetail::optimizer {

inline constexpr const char *kStartPhase = "start", *kScanPhase = "scan";

/// One candidate of a run.
struct Candidate {
  std::vector<double> x;  ///< design-space order, file units
  Evaluation evaluation;
  Judgement judgement;
  std::string phase;      ///< start | scan | NAME of the algorithm
  bool replayed = false;  ///< answered by the journal
};

/// Told after each candidate, in the order of the run, on the calling thread.
struct Progress {
  std::size_t index;  ///< of the candidate, from 0
  const Candidate& candidate;
  std::optional<std::size_t> best;  ///< best feasible so far
};

/// Evaluates a point of the design space on a finer mesh: level 1 that of the verification, every further one with half
/// the size.
using FinerEvaluator = std::function<Evaluation(std::span<const double> x, int level)>;

/// How a candidate keeps the limits on a finer mesh.
struct FinerCheck {
  std::size_t candidate = 0;
  int level = 1;
  Evaluation evaluation;
  std::vector<double> constraints;  ///< c in the order of constraint_names, NaN unless computed
  bool held = false;                ///< every c <= the tolerance

  /// As the evaluation says; 0 if it does not.
  [[nodiscard]] int flank_elements() const {
    const auto found = evaluation.parameters.find("mesh.flank_elements");
    return found == evaluation.parameters.end() ? 0 : static_cast<int>(found->second);
  }
};

/// Evaluates many points at once and tells of each by its place as it is there, on this thread. When `told` returns
/// false no more are begun.
using BatchEvaluator = std::function<void(const std::vector<std::vector<double>>& points,
                                          const std::function<bool(std::size_t place, Evaluation)>& told)>;

/// One of so many, counted from 1.
struct Part {
  int number = 1, of = 1;
};

/// What a run is connected to. All optional.
struct RunHooks {
  Journal* journal = nullptr;                          ///< answers what it holds, records what is new
  std::function<void(const Progress&)> progress = {};  ///< may throw: the run ends and the exception reaches the caller
  const std::atomic<bool>* stop = nullptr;             ///< looked at between evaluations
  std::function<bool()> time_over = {};  ///< no candidate is begun where it says so: the budget is used up
  FinerEvaluator finer = {};             ///< without: limits are kept on the mesh of the search alone
  BatchEvaluator many = {};              ///< in place of the evaluator: several candidates at once
  Journal* finer_journal = nullptr;      ///< of it; x is followed by the level
  std::optional<Part> part = {};         ///< start and that part of the scan, and no search: others compute the rest
};

struct SearchStatistics {
  int computed = 0;            ///< evaluator calls
  int replayed = 0;            ///< answered by the journal
  int repeated = 0;            ///< asked again by the algorithm, answered by the cache
  int infeasible = 0;          ///< geometric rule broken
  int failed = 0;              ///< not converged
  int gradients = 0;           ///< gradients asked for
  int gradient_fallbacks = 0;  ///< components set to 0 because no neighbour could be computed
  int unused_records = 0;      ///< journal records the run did not come back to (0 when the replay is exact)
};

struct OptimizationResult {
  /// converged: the algorithm's stopping rule held; iteration_limit: the budget was used up; interrupted; stalled: the
  /// algorithm gave up (message says why). Says nothing about feasibility: look at `best`.
  Status status = Status::stalled;
  std::optional<std::size_t> best;          ///< feasible candidate with the least objective; of a front its compromise
  std::optional<Front> front;               ///< where one was asked for and something is feasible
  std::optional<std::size_t> least_broken;  ///< without `best`: the candidate nearest to feasible
  std::vector<Candidate> evaluations;       ///< in the order asked for
  std::vector<FinerCheck> finer;            ///< in the order asked for
  std::string message;
  SearchStatistics statistics;
};

/// Minimises the problem: the start, `scan_evaluations` Latin-hypercube candidates, then the algorithm from the best
/// seen, then restarts with smaller steps while budget is left.
///
/// With hooks.finer the limits hold on finer meshes, too: what one level finer changes in the constraints of the best
/// design so far is added to them before the algorithm starts; where it ends, the best design is evaluated on
/// `finer_meshes` finer ones, and when it breaks a limit there, the constraints are shifted by what was seen and the
/// search goes on from there with small steps. Where that refuses everyone, the one it refuses by the least is looked
/// at itself, and the search begins anew with what is seen there. `best` then is a design that keeps its limits on all
/// of them, and `feasible` of a Judgement says that its values leave room for the shifts, or that it was seen to hold.
///
/// Of a front algorithms find points, see pagmo_search.hpp (nsga2) and front_search.hpp (all others); the scan has at
/// least one generation of nsga2 and de. Limits are corrected by what the candidate with the least first objective
/// changes, and the compromise has to keep them; the points beside it are judged with the shifts these looks bring.
///
/// Same problem, options and evaluator give the same candidates bit by bit, however many are computed at once. To
/// resume, run again with the journal: it answers the candidates it holds, the algorithm takes the same path and
/// continues it. What the evaluator throws reaches the caller; everything evaluated before is in the journal.
///
/// Throws InputError for a wrong problem or options. Cost: max_evaluations evaluations; the rest is negligible.
[[nodiscard]] OptimizationResult run_optimization(const Problem& problem, const Evaluator& evaluator,
                                                  const OptimizerOptions& options, const RunHooks& hooks = {});

}  // namespace dovetail::optimizer
