#pragma once

#include "optimizer/bars/bars.hpp"

namespace dovetail::optimizer {

/// Adds what the ends of worn zones and a doubt of the worn state leave open of the responses of the worn joint.
void add_worn_bars(const Scene& scene, const CandidateResult& result, Bars& bars);

}  // namespace dovetail::optimizer
