#pragma once

#include "optimizer/bars/other_meshes.hpp"
#include "optimizer/mission/mission_result.hpp"

namespace dovetail::optimizer {

/// Fills error_sources and error_estimates of a mission that converged, by the companions and parts of add_error_bars,
/// each of all loads: mesh, contact_grid (longer nodes on one grid of all), modes, prestress, harmonics, samples,
/// pseudo_penalty, edge, search; and
///
/// - order: how far other orders of the loads end from it, where no alternating history confirms it;
/// - history: how far the alternating history does, where one was asked; all of it where that came to no end.
///
/// What depends on volume depends on it in proportion. A joint that no load wears has no bar of its own: at least those
/// of its cases are its, see `together`.
/// Cost: five to nine missions, on coarser meshes most of them.
void add_mission_bars(const MissionLoads& loads, const ModelBuilder& builder, const OtherMeshes& others,
                      MissionResult& result);

/// Models of all loads.
[[nodiscard]] std::vector<CandidateModel> models_of(const MissionLoads& loads, const ModelBuilder& builder);

}  // namespace dovetail::optimizer
