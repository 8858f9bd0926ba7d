#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "optimizer/problem/load_case.hpp"

namespace dovetail::optimizer {

/// Cases that act in turn on the same flanks, by their places; of a design without cases its one load.
struct MissionCases {
  std::vector<std::size_t> cases;
  bool named = true;  ///< the study names a response of it: without an answer the design has failed
};

/// The missions of a study: all cases, or of uncertain numbers the cases of every sample.
/// None where cases differ in their geometry: they have no flanks in common.
/// - `named`: the study names a response of them; else there is a mission only where there are [[case]]s
[[nodiscard]] std::vector<MissionCases> missions_of(std::span<const LoadCase> cases, bool named);

}  // namespace dovetail::optimizer
