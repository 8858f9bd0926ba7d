// What friction takes, by slip next to the sharp ends of flanks.
#include "optimizer/candidate/candidate_result.hpp"
#include "optimizer/responses/response_table.hpp"

namespace dovetail::optimizer {

const Response kDissipatedEnergy{
    .name = "dissipated_energy_j",
    .unit = "J",
    .help = "Energy lost to friction in one period at the unworn resonance.",
    .stage = Stage::unworn,
    .value = [](const Scene&, const CandidateResult& result) { return result.unworn->state.friction_energy; },
    .mesh_order = {1.6},
    .amount = true,
    .off = [](const CandidateResult&, const LeftOpen& open) { return open.slip_energy; }};

}  // namespace dovetail::optimizer
