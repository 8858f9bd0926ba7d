#pragma once

#include "optimizer/search/search_outcome.hpp"

namespace dovetail::optimizer {

/// Interior-point search by Ipopt [Waechter, Biegler 2006] with limited-memory Hessians. A candidate without physics
/// makes it cut its step; a gradient never fails (SearchFunctions::gradient falls back). The start must be computed,
/// otherwise the outcome is `stalled` and says so. Ipopt's solver MUMPS crashes when two threads solve at once: a
/// mutex lets one search run at a time in a process, evaluations included; an evaluator must not call it.
///
/// Throws StopSearch and what the evaluator throws. Deterministic.
[[nodiscard]] SearchOutcome ipopt_search(SearchFunctions& functions, const std::vector<double>& start);

}  // namespace dovetail::optimizer
