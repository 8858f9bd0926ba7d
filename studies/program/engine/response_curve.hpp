#pragma once

#include <optional>
#include <string>
#include <vector>

#include "paths/continuation.hpp"
#include "studies/program/engine/point_analysis.hpp"

namespace dovetail::studies {

/// The answer of the command response.
struct ResponseCurve {
  std::vector<double> frequency_hz;  ///< [F]
  std::vector<steady::State> states;
  std::vector<std::string> output_names;
  steady::Options settings = {};           ///< with the harmonics and samples chosen
  contact::PseudoPenalty penalty = {};     ///< of the nodes, before the cascade changes it at a point
  std::optional<Status> automatic = {};    ///< of the choice of harmonics and samples, when it was asked for
  double accuracy = 0;                     ///< asked for with it
  std::optional<branches::Branch> branch;  ///< of an arc-length run; its points have no states any more
  AnalysisChoice choice = {};
  std::vector<PointAnalysis> analyses = {};  ///< [F] when something is chosen
};

/// {"frequency_hz":[F], "status":[F], "iterations":[F], "outputs":{NAME:{"amplitude":[F], "cosine":[F][H+1],
/// "sine":[F][H+1]}}, "dissipated_energy_j":[F], "error_force":[F], "error_energy":[F],
/// "wear_rate_m_per_cycle":[F][Nc]} and, besides, "settings", "residual":[F], "penalty_ratio":[F]; on request
/// "arclength", "error_bars", "penalty_sensitivity", "stability", "traction_bounds". At a point that did not converge
/// everything but frequency, status, iterations and residual is null.
[[nodiscard]] std::string response_json(const ResponseCurve& curve);

/// A table for people: frequency, status, the amplitude of each output, and a column for each analysis.
[[nodiscard]] std::string response_table(const ResponseCurve& curve);

}  // namespace dovetail::studies
