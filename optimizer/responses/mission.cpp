// How much all cases of load together take off the same flanks until none of them wears these any further.
#include "optimizer/responses/response_table.hpp"

namespace dovetail::optimizer {

const Response kMissionVolume{
    .name = "mission_wear_volume_m3",
    .unit = "m^3",
    .help = "Volume worn off when no case, all acting in turn on the same flanks, wears them any further.",
    .stage = Stage::worn_state,
    .value = nullptr,
    .mesh_order = {1.5},
    .by_zone_ends = true,
    .amount = true,
    .alone = &kWornVolume};

const Response kMissionDepth{.name = "mission_wear_depth_max_m",
                             .unit = "m",
                             .help = "Largest wear depth of these flanks, both surfaces together.",
                             .stage = Stage::worn_state,
                             .value = nullptr,
                             .mesh_order = {2},
                             .by_zone_ends = true,
                             .alone = &kWornDepth};

const Response kMissionDrift{.name = "mission_drift",
                             .unit = "",
                             .help = "Resonance in a case on these flanks over that of the unworn joint, minus one.",
                             .stage = Stage::worn_resonance,
                             .value = nullptr,
                             .mesh_order = {2.5},
                             .grid_order = 7.0 / 3,
                             .by_zone_ends = true,
                             .either_sign = true,
                             .alone = &kResonanceDrift};

}  // namespace dovetail::optimizer
