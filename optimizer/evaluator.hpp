#pragma once

#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "optimizer/bars/other_meshes.hpp"
#include "optimizer/candidate/candidate_result.hpp"
#include "optimizer/mission/mission_result.hpp"

namespace dovetail::optimizer {

/// How much an evaluation has to answer for. A search compares many designs and leaves bars and histories out.
struct Purpose {
  bool bars = true;                     ///< error bars of all responses there are
  bool truncation_alone = false;        ///< of those the parts by harmonics, samples and pseudo-penalty alone
  bool history = true;                  ///< where the direct worn state is in doubt, the wear history decides
  Stage until = Stage::worn_resonance;  ///< the last one that is computed; responses of later ones have no value
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
  /// A study is about the responses it names: their bars may need what others can do without.
  explicit SceneEvaluator(const Scene& reference, std::vector<std::string> named = {});

  /// All responses. Never throws for what a candidate is like: an impossible geometry is "infeasible" with its rules in
  /// `constraints`, a stage that did not converge is named in `status`. Throws InputError for a scene that violates the
  /// ranges of its keys. Cost: about a second at the default sizes, and eight times as much for the bars.
  [[nodiscard]] CandidateResult evaluate(const Scene& scene, const Purpose& purpose = {}) const;

  /// What the loads wear off together. With a history of the purpose, whether one in which they alternate confirms it,
  /// too. Cost: about 1.5 times the evaluations of all loads; with history three times.
  [[nodiscard]] Evaluation evaluate_mission(const MissionLoads& loads, const Purpose& purpose = {}) const;

  [[nodiscard]] const ModelBuilder& builder() const { return builder_; }
  [[nodiscard]] const Scene& reference() const { return reference_; }

 private:
  /// Made when a design first asks for bars: they take longer than a design without.
  [[nodiscard]] const OtherMeshes& others() const;

  Scene reference_;
  std::vector<std::string> named_;
  ModelBuilder builder_;
  mutable std::once_flag once_;
  mutable std::optional<OtherMeshes> others_;
};

}  // namespace dovetail::optimizer
