#pragma once

#include "optimizer/bars/bars.hpp"

namespace dovetail::optimizer {

/// Adds what zones at the ends of the contact that are narrower than half a node, and so not seen, leave open of a
/// joint without wear; returns what they leave open of the friction energy, J per cycle.
double add_unseen_zones(const Scene& scene, CandidateResult& result, Bars& bars);

/// What the nodes at the ends of slipping zones leave open of the friction energy, J per cycle.
[[nodiscard]] double slip_at_zone_ends(const CandidateResult& result);

}  // namespace dovetail::optimizer
