#pragma once

namespace dovetail::studies {

/// What is computed of each point of a response besides itself.
struct AnalysisChoice {
  bool error_bars = false, penalty_sensitivity = false, stability = false, traction_bounds = false;

  [[nodiscard]] bool any() const { return error_bars || penalty_sensitivity || stability || traction_bounds; }
};

}  // namespace dovetail::studies
