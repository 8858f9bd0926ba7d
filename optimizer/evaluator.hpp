#pragma once

#include <atomic>
#include <optional>
#include <string>

#include "optimizer/candidate_model.hpp"
#include "optimizer/contact_fit.hpp"
#include "optimizer/evaluation.hpp"
#include "optimizer/fillet_stress.hpp"
#include "optimizer/other_meshes.hpp"
#include "paths/resonance.hpp"
#include "wear/asymptote/asymptote.hpp"
#include "wear/asymptote/drift.hpp"

namespace dovetail::optimizer {

/// Everything an evaluation computed, for reports and exports. Members after the stage that failed are empty.
struct CandidateResult {
  Evaluation evaluation;
  CandidateModel model;
  std::optional<paths::Resonance> unworn, worn;
  std::optional<wear::Asymptote> asymptote;
  std::optional<wear::Asymptote> held;  ///< where the resonance was followed: the one at the unworn resonance
  std::optional<FilletStress> blade_fillet, disk_fillet;
};

/// How much an evaluation has to answer for. A search compares many designs and leaves both out.
struct Purpose {
  bool bars = true;     ///< error bars of all responses
  bool history = true;  ///< where the direct worn state is in doubt, the wear history decides
  bool wear = true;     ///< else the responses of the unworn joint alone, and no bars
};
inline constexpr Purpose kSearch{.bars = false, .history = false};

/// Evaluates candidates of one study: the one place that names all stages in order,
///
///   geometry -> mesh -> finite elements -> reduced model -> preload -> unworn resonance -> wear at that frequency
///   down to its asymptote -> worn resonance -> responses.
///
/// Results depend on the reference scene (mesh topology) and the candidate only. May be called from several threads.
class SceneEvaluator {
 public:
  explicit SceneEvaluator(const Scene& reference);

  /// All responses. Never throws for what a candidate is like: an impossible geometry is "infeasible" with its rules in
  /// `constraints`, a stage that did not converge is named in `status`. Throws InputError for a scene that violates the
  /// ranges of its keys. Cost: about a second at the default sizes, and eight times as much for the bars.
  [[nodiscard]] CandidateResult evaluate(const Scene& scene, const Purpose& purpose = {}) const;

  [[nodiscard]] const ModelBuilder& builder() const { return builder_; }
  [[nodiscard]] const Scene& reference() const { return reference_; }

 private:
  Scene reference_;
  ModelBuilder builder_;
  OtherMeshes others_;
};

/// The physics on a model that converged: contact nodes fitted to the worn zones, then all responses, without bars.
[[nodiscard]] CandidateResult computed(const Scene& scene, CandidateModel model, const Computation& how = {});

/// Options of every steady state of a scene.
[[nodiscard]] steady::Options steady_options(const SolverSettings& settings);

/// The joint of a candidate with these options, on its budget.
[[nodiscard]] steady::Joint joint_of(const Scene& scene, const CandidateModel& model, double penalty_scale = 1);

}  // namespace dovetail::optimizer
