// How much wear takes off until it comes to rest.
#include "optimizer/candidate/candidate_result.hpp"
#include "optimizer/responses/response_table.hpp"

namespace dovetail::optimizer {

const Response kWornVolume{
    .name = "asymptotic_wear_volume_m3",
    .unit = "m^3",
    .help = "Volume worn off both surfaces of both flanks when wear has come to rest.",
    .stage = Stage::worn_state,
    .value = [](const Scene&, const CandidateResult& result) { return result.asymptote->worn_volume; },
    .mesh_order = {1.5},
    .by_zone_ends = true,
    .amount = true,
    .off = [](const CandidateResult&, const LeftOpen& open) { return open.worn_volume; }};

// Most of the worn joint bears on its inner parts: so does its largest depth.
const Response kWornDepth{
    .name = "asymptotic_wear_depth_max_m",
    .unit = "m",
    .help = "Largest wear depth, both surfaces together, when wear has come to rest.",
    .stage = Stage::worn_state,
    .value = [](const Scene&, const CandidateResult& result) { return result.asymptote->largest_depth; },
    .mesh_order = {2},
    .by_zone_ends = true,
    .off = [](const CandidateResult&, const LeftOpen& open) { return open.worn_depth; }};

}  // namespace dovetail::optimizer
