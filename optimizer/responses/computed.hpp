#pragma once

#include "optimizer/candidate/candidate_result.hpp"

namespace dovetail::optimizer {

/// The physics on a model that converged, and the responses of the stages it came through, without bars.
[[nodiscard]] CandidateResult computed(const Scene& scene, CandidateModel model, const Computation& how = {});

}  // namespace dovetail::optimizer
