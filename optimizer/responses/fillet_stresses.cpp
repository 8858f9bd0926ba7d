// Stresses on the fillets beside the flanks, for which what the free surface says of them counts besides.
#include <algorithm>

#include "optimizer/candidate/candidate_result.hpp"
#include "optimizer/responses/response_table.hpp"

namespace dovetail::optimizer {

namespace {

// Two or three elements on a fillet in space are too few for the order of finer meshes.
constexpr MeshOrder kFillet{.in_plane = 2.8, .in_space = 1.5};

}  // namespace

const Response kBladeFilletStress{
    .name = "blade_fillet_stress_pa",
    .unit = "Pa",
    .help =
        "Smooth maximum of the von Mises stress on the blade's neck fillets, over a period at the unworn resonance; "
        "it fades out from 0.35 to 0.2 fillet radii from the flank's end, whose singularity is not the fillet's.",
    .stage = Stage::unworn,
    .value = [](const Scene&, const CandidateResult& result) { return result.blade_fillet->aggregate; },
    .mesh_order = kFillet,
    .own_error = {"mesh",
                  [](const Scene&, const CandidateResult& result) { return result.blade_fillet->aggregate_error; }}};

const Response kDiskFilletStress{
    .name = "disk_fillet_stress_pa",
    .unit = "Pa",
    .help =
        "Smooth maximum of the von Mises stress on the disk's slot fillets, over a period at the unworn resonance, "
        "faded out like the blade's.",
    .stage = Stage::unworn,
    .value = [](const Scene&, const CandidateResult& result) { return result.disk_fillet->aggregate; },
    .mesh_order = kFillet,
    .own_error = {"mesh",
                  [](const Scene&, const CandidateResult& result) { return result.disk_fillet->aggregate_error; }}};

const Response kPeakStress{
    .name = "peak_stress_pa",
    .unit = "Pa",
    .help =
        "Largest nodal von Mises stress on the fillets, over a period at the unworn resonance, from 0.35 fillet "
        "radii beyond the flanks' ends on.",
    .stage = Stage::unworn,
    .value =
        [](const Scene&, const CandidateResult& result) {
          return std::max(result.blade_fillet->maximum, result.disk_fillet->maximum);
        },
    .mesh_order = {1.3},
    .own_error = {"mesh", [](const Scene&, const CandidateResult& result) {
                    return std::max(result.blade_fillet->maximum_error, result.disk_fillet->maximum_error);
                  }}};

}  // namespace dovetail::optimizer
