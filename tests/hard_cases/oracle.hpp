#pragma once

#include <Eigen/Core>

#include "tests/hard_cases/problem.hpp"

namespace dovetail::hard_cases {

/// What a converged state claims: everything the check takes from the engine.
struct Claim {
  Eigen::MatrixXd displacement;        ///< U [nc, 2H+1], m
  Eigen::VectorXd normal, tangential;  ///< the eps it was solved with [Nc], N/m
  double friction_energy = 0;          ///< J per cycle
  double input_energy = 0, damping_energy = 0, contact_work = 0;
};

/// Findings of the independent check, all dimensionless.
struct Verdict {
  double residual = 0;       ///< |F - Z U - lambda| on the engine's samples, relative to the excitation
  double rounding = 0;       ///< what double precision leaves of that difference and of the check's own march
  double fine_residual = 0;  ///< the same on 16 times as many samples, relative to |F| + |lambda|
  double penetration = 0;    ///< largest u_N - g - W beyond what the truncation of the series leaves, relative
  double tension = 0;        ///< the same for pulling forces
  double cone = 0;           ///< and for tangential forces beyond mu lambda_N
  double energy = 0;         ///< |input - damping - contact work| relative to the forces times displacements in them
  bool periodic = true;      ///< the march repeats
};

/// Condenses the model itself, marches the contact law itself from its own Fourier sums, and compares. Nothing of
/// dovetail::contact, dovetail::numerics or dovetail::response takes part. O(n^3 H + Nc N H).
[[nodiscard]] Verdict examine(const Problem& problem, const Claim& claim);

/// Empty when the verdict is consistent with a converged solve at the tolerance, else what is wrong.
[[nodiscard]] std::string objection(const Problem& problem, const Verdict& verdict);

}  // namespace dovetail::hard_cases
