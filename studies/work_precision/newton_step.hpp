#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "steady/state.hpp"
#include "studies/work_precision/contact_patch.hpp"

namespace dovetail::work_precision {

/// A converged steady state of a contact patch, the point at which costs are measured.
struct PatchState {
  std::shared_ptr<const dynamics::CondensedModel> model;
  steady::State state;
  int stuck = 0, slipping = 0, separating = 0;  ///< nodes; one that slips may also lift off

  [[nodiscard]] const std::shared_ptr<const steady::Problem>& problem() const { return state.tangent->point().problem; }
  [[nodiscard]] bool converged() const { return state.status == Status::converged; }
};

[[nodiscard]] PatchState solve_patch(const PatchOptions& options, int harmonics, int samples);

/// Seconds (processor time, median of repetitions) of one Newton step and of its parts.
struct StepTimes {
  Status status = Status::converged;  ///< of the steady state; nothing is measured unless converged
  Eigen::Index nodes = 0, unknowns = 0, factorised = 0;
  int harmonics = 0, samples = 0, stuck = 0;
  double residual = 0;    ///< f(U)
  double derivative = 0;  ///< f(U) and D in nodal blocks
  double jacobian = 0;    ///< dense J of all unknowns from D
  double lu = 0;          ///< dense LU of all unknowns
  double linearise = 0;   ///< J of the unknowns that are left, condensed, and its LU
  double solve = 0;       ///< one right-hand side
  double step = 0;        ///< f, D, linearise and solve
};

/// Each part is repeated until `seconds` have passed, three times at least.
[[nodiscard]] StepTimes measure_step(const PatchOptions& options, int harmonics, int samples, double seconds);

}  // namespace dovetail::work_precision
