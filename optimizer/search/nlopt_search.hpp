#pragma once

#include "optimizer/search/search_outcome.hpp"

namespace dovetail::optimizer {

/// Runs one algorithm of NLopt [Johnson, The NLopt nonlinear-optimization package] from `start`, first step `step`:
///
/// | name | constraints | gradient |
/// |---|---|---|
/// | cobyla | own: linear models | no |
/// | bobyqa, neldermead, sbplx | augmented Lagrangian around it, see below | no |
/// | isres | own: stochastic ranking; global, runs to the end of the budget | no |
/// | crs2, direct_l | exact penalty f + 10 sum max(0, c); global | no |
/// | mma, slsqp | own | yes |
///
/// Augmented Lagrangian [Powell 1969; Hestenes 1969; Rockafellar 1973]: minimise
/// `L(u) = f + rho/2 sum max(0, c_j + lambda_j/rho)^2`, then `lambda_j = max(0, lambda_j + rho c_j)`, from rho = 10;
/// rho grows tenfold when the violation does not fall to a quarter; each round starts at the last one's end with half
/// its step. Without active constraints one round is all.
///
/// Throws StopSearch and what the evaluator throws. Deterministic for a seed.
[[nodiscard]] SearchOutcome nlopt_search(Algorithm algorithm, SearchFunctions& functions,
                                         const std::vector<double>& start, double step, std::uint64_t seed);

/// Whether the algorithm searches the whole box (no restarts then).
[[nodiscard]] bool is_global(Algorithm algorithm);

}  // namespace dovetail::optimizer
