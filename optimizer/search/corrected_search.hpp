#pragma once

#include "optimizer/search/finer_limits.hpp"
#include "optimizer/search/front.hpp"
#include "optimizer/search/search_outcome.hpp"
#include "optimizer/search/session.hpp"

namespace dovetail::optimizer {

/// The search with its limits corrected by what finer meshes say, at its start and where it ends. Its best candidate
/// keeps its limits on them, or there is none. Throws StopSearch when it was asked to.
[[nodiscard]] SearchOutcome corrected_search(EvaluationSession& session, FinerLimits& finer);

/// Points of a front, of which the compromise keeps its limits on finer meshes. Throws as corrected_search().
[[nodiscard]] SearchOutcome corrected_front(EvaluationSession& session, FinerLimits& finer);

/// The front among the candidates so far.
[[nodiscard]] Front front_in(const EvaluationSession& session);

}  // namespace dovetail::optimizer
