#pragma once

#include <map>
#include <string>

#include "optimizer/evaluator.hpp"

namespace dovetail::optimizer {

/// Error bars of the responses of a converged evaluation, by response name, SI. Each is the change under finer
/// settings (twice the harmonics plus one, twice the samples) at the computed states, plus what is known of the
/// other discretisations: the estimated error of the reduction for frequencies, the tolerance of the
/// resonance search, and for worn volume and depth the bracket left open by the nodes at the edge of the worn zone.
/// The finite-element mesh is not covered. A refined state that does not converge gives an infinite bar.
/// Cost: about twenty Jacobians of twice the size.
[[nodiscard]] std::map<std::string, double> error_estimates(const Scene& scene, const CandidateResult& result);

}  // namespace dovetail::optimizer
