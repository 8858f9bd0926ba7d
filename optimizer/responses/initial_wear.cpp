// How fast wear begins, which is slip next to the sharp ends of flanks.
#include "optimizer/candidate/candidate_result.hpp"
#include "optimizer/responses/response_table.hpp"

#include "wear/measures.hpp"

namespace dovetail::optimizer {

const Response kInitialWearRate{
    .name = "initial_wear_rate_m3_per_cycle",
    .unit = "m^3 per cycle",
    .help = "Volume worn off per cycle while the flanks are unworn.",
    .stage = Stage::unworn,
    .value =
        [](const Scene&, const CandidateResult& result) {
          return wear::worn_volume(result.model.model.contact, result.unworn->state.wear_rate);
        },
    .mesh_order = {1.6},
    .amount = true,
    .off = [](const CandidateResult& result, const LeftOpen& open) -> std::optional<double> {
      if (!open.slip_energy) return {};
      return worn_per_energy(result, *open.slip_energy) * *open.slip_energy;
    }};

}  // namespace dovetail::optimizer
