#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "optimizer/evaluator.hpp"
#include "optimizer/run.hpp"
#include "wear/control.hpp"

namespace dovetail::optimizer {

struct VerificationOptions {
  // >= 1. Steps of the history whose increments add up to the directly computed depth; it may take three times as many.
  int steps = 60;
};

/// A design's wear by the full history against the direct method, both with twice the harmonics plus one and twice the
/// samples, so that settings and path are checked at once. Depths are nodal answers of both.
struct Verification {
  /// "converged": both ended where wear rests; otherwise what failed and why, or "interrupted".
  std::string status = "converged";
  int harmonics = 0, samples = 0;
  std::string follow;                            ///< fixed | resonance, as the design's loading says
  double frequency_hz = 0;                       ///< of the unworn resonance at these settings
  double search_volume = 0, search_bar = 0;      ///< m^3, as the search saw it, and its error bar
  double search_depth = 0;                       ///< m
  double direct_volume = 0, direct_depth = 0;    ///< m^3, m
  double history_volume = 0, history_depth = 0;  ///< m^3, m
  double profile_difference = 0;                 ///< largest |direct - history| of a node over the largest direct depth
  double cycles = 0;                             ///< of the history
  int direct_solves = 0, history_solves = 0;
  Eigen::VectorXd search_profile, direct_profile, history_profile;  ///< [Nc] m
  double seconds = 0;
  CandidateModel model;  ///< of the design

  [[nodiscard]] bool converged() const { return status == "converged"; }
};

/// Never throws for what a design is like; what could not be computed is in the status. Cost: an evaluation and about
/// 100 steady states of twice the size.
[[nodiscard]] Verification verify(const SceneEvaluator& evaluator, const Scene& scene,
                                  const VerificationOptions& options = {}, const wear::Control& control = {});

}  // namespace dovetail::optimizer
