#pragma once

#include <optional>
#include <string>
#include <vector>

#include "optimizer/candidate/candidate_model.hpp"
#include "optimizer/candidate/contact_fit.hpp"
#include "optimizer/problem/evaluation.hpp"
#include "paths/resonance.hpp"
#include "wear/mission/mission.hpp"

namespace dovetail::optimizer {

/// A design in all cases that act in turn on its flanks.
struct MissionLoads {
  struct Load {
    std::string name;  ///< of the case; empty: there is one load, and no case
    double share = 1;  ///< > 0, of the life; of interest for the history alone
    Scene scene;       ///< of one geometry and mesh; loads differ in speed, force, friction, ...
  };
  std::vector<Load> all;
  std::vector<std::size_t> by_sharing =
      {};  ///< their indices, those that share matrices in a row; empty: as they stand
};

/// The flanks when no load wears them any further, and the joint on them. Members after what failed are empty.
struct MissionResult {
  /// Its responses are those of a mission, a drift for every case (of_case). Its `model` tells of the grid, of other
  /// orders of the loads and of the alternating history, under names that begin with kMissionPrefix.
  Evaluation evaluation;
  std::vector<CandidateModel> models;  ///< of every load, with the same contact nodes
  ContactFit fit;
  std::vector<paths::Resonance> unworn, worn;  ///< of every load
  std::optional<wear::Mission> mission;
};
inline constexpr const char* kMissionPrefix = "mission_";

/// One grid of contact nodes for all loads, laid for the worn zones of the mission; then the unworn resonances, at
/// which the loads wear, the mission, and the worn resonances. With `how.history` the loads are let act in turn,
/// too, with a history where that is in doubt.
/// - `models`: of the loads, built
/// - `from`: the same at other settings, to begin with, or null; its grid where `how.grid_from` says so
[[nodiscard]] MissionResult mission_of(const MissionLoads& loads, std::vector<CandidateModel> models,
                                       const Computation& how, const MissionResult* from = nullptr);

struct AlternatingOptions {
  // > 0. Largest increment of depth of the first history over the largest local penetration of the unworn contact, the
  // depth over which loads change; the second takes half of it, and what both extrapolate to is the answer.
  double increment = 0.25;
  // > 0. Of the first rate, below which nothing wears any more. At 1e-3 a rare load has not worn its part yet: of two
  // loads, one twenty times as frequent, the volume was 8 % short.
  double rate_fraction = 1e-5;
  int steps = 1200;    // >= 1, of either
  double budgets = 4;  // > 0, of an evaluation, for either
  // > 0, of the volume. A history that ends nearer than that to the direct answer, within its own bar, or within a node
  // at the ends of worn zones - it wears off whole ones - confirms it.
  double confirms = 0.03;
};

/// Holds an answer against a history in which the loads alternate: into the evaluation's `model` and `messages`.
void confirm_by_history(const MissionLoads& loads, MissionResult& result, const AlternatingOptions& options = {});

}  // namespace dovetail::optimizer
