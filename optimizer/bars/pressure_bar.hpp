#pragma once

#include "optimizer/bars/bars.hpp"
#include "optimizer/scene/scene.hpp"

namespace dovetail::optimizer {

struct CandidateResult;

/// Completes the bar of the peak of pressure at ends of flanks that are round or rough, after meshes and contact grids
/// have been asked; leaves it open where the mesh does not resolve the peak.
void add_peak_pressure(const Scene& scene, CandidateResult& result, Bars& bars);

}  // namespace dovetail::optimizer
