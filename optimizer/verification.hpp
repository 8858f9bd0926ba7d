#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "optimizer/evaluator.hpp"
#include "optimizer/search/run.hpp"
#include "wear/follow.hpp"
#include "wear/watcher.hpp"

namespace dovetail::optimizer {

struct VerificationOptions {
  // > 0. Largest increment of depth of the first history, relative to the largest local penetration of the unworn
  // contact (lambda_N over the node's own stiffness): the depth over which loads change. The second takes half of it.
  // Twice as large the volume does not yet change with the first power of the increment.
  double increment = 0.125;
  // >= 1. Steps of either history at most.
  int steps = 1200;
  // 0 < . <= 1. Of the search's bar, by which the histories' volume may differ from it, beside their own bar: most of
  // the bar is what mesh and solver leave, which both share; histories wear off whole nodes.
  double of_bar = 0.5;
  // > 0. Budget of either history, in budgets of an evaluation (solver.max_jacobians and time_limit of the scene).
  double budgets = 4;
};

/// A design's wear asked for in two other ways: directly at finer settings, which says whether the mesh and what the
/// solver leaves out are in the bars, and at its own settings by two explicit histories that know nothing of the direct
/// answer, extrapolated to no increment, which say whether the method is right. At finer settings histories would cost
/// tens of evaluations and say the same.
struct Verification {
  /// Converged: both agree with the search within their bars; else they disagree, whatever failed beside it; or what
  /// failed and why, or interrupted.
  std::string status = status_of(Outcome::converged);
  int flank_elements = 0, harmonics = 0, samples = 0;  ///< of the finer direct answer
  wear::Follow follow = wear::Follow::fixed;           ///< as the design's loading says
  double frequency_hz = 0;                             ///< where the histories begin: the design's unworn resonance
  double search_volume = 0, search_bar = 0;            ///< m^3, at the settings of the search, and its error bar
  double search_depth = 0;                             ///< m
  double direct_volume = 0, direct_depth = 0;          ///< m^3, m, at finer settings; no profile where it failed
  double history_volume = 0, history_depth = 0;        ///< m^3, m, extrapolated; no profile where one failed
  double history_bar = 0;                              ///< m^3, of the extrapolation: the change by the last halving
  double profile_difference = 0;                       ///< largest |search - history| of a node over the search's depth
  double cycles = 0;                                   ///< of the finer history
  int direct_solves = 0, history_solves = 0;
  Eigen::VectorXd search_profile, direct_profile, history_profile;  ///< [Nc] m, on the contact nodes of the search
  double seconds = 0;

  [[nodiscard]] bool converged() const { return outcome_of(status) == Outcome::converged; }
};

/// The scene on a mesh with 2^level times the edges along the flanks; with 2H+1 harmonics and 2N samples, no more of
/// each than its key allows; and with its own preload in the stiffness where designs share theirs.
[[nodiscard]] Scene finer(Scene scene, int level);

/// A design on such a mesh; never with bars.
[[nodiscard]] CandidateResult evaluated_finer(const SceneEvaluator& evaluator, const Scene& scene,
                                              const Purpose& purpose, int level);

/// All loads of it there.
[[nodiscard]] Evaluation mission_finer(const SceneEvaluator& evaluator, MissionLoads loads, int level);

/// A design at finer settings, and the scene that fixes the topology of its mesh.
struct FinerDesign {
  Scene scene, reference;
};

/// At finer(scene, 1).
[[nodiscard]] FinerDesign twice_as_fine(const SceneEvaluator& evaluator, const Scene& scene);

/// `result`: the design as the search has it, with bars; `there`: settings of more edges along the flanks.
///
/// Never throws for what a design is like; what could not be computed is in the status. Cost: an evaluation at those
/// settings and some 50 to 300 steady states at the design's own.
[[nodiscard]] Verification verify(const Scene& scene, const CandidateResult& result, const FinerDesign& there,
                                  const VerificationOptions& options = {}, const wear::Watcher& watcher = {});

/// The same with twice as fine settings of a design that is computed first.
[[nodiscard]] Verification verify(const SceneEvaluator& evaluator, const Scene& scene,
                                  const VerificationOptions& options = {}, const wear::Watcher& watcher = {});

}  // namespace dovetail::optimizer
