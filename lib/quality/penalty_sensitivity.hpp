#pragma once

#include <memory>
#include <vector>

#include "quality/quantities.hpp"

namespace dovetail::quality {

struct PenaltySensitivityOptions {
  std::vector<double> ratios = {0.5, 1, 2, 10};  ///< of eps to the one the state was computed with, each > 0
  double step = 0.1;                             ///< of ln eps in the slopes, > 0
};

/// How much results depend on the pseudo-penalty eps, which the exact answer does not contain: what is left of
/// it is truncation error.
struct PenaltySensitivity {
  Status status = Status::iteration_limit;  ///< converged: all states did; otherwise of the first that did not
  std::vector<double> ratios;
  std::vector<Status> statuses;    ///< one per ratio
  std::vector<Quantities> values;  ///< one per ratio; NaN where its state did not converge
  Quantities slope;                ///< d ln Q / d ln eps at ratio 1, a central difference; 0 where Q = 0
  int jacobians = 0;
};

/// Of the steady state near a converged `state` of the joint; each ratio is started from its neighbour.
/// Both penalties of all nodes are scaled together.
[[nodiscard]] PenaltySensitivity penalty_sensitivity(const steady::Joint& joint, const steady::State& state,
                                                     const PenaltySensitivityOptions& sensitivity = {});

}  // namespace dovetail::quality
