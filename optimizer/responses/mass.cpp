// What a blade weighs.
#include "optimizer/candidate/candidate_result.hpp"
#include "optimizer/responses/response_table.hpp"

namespace dovetail::optimizer {

const Response kMass{
    .name = "mass_kg",
    .unit = "kg",
    .help = "Mass of one blade.",
    .stage = Stage::model,
    .value = [](const Scene& scene,
                const CandidateResult& result) { return scene.kind->blade_mass(scene, result.model.mesh.sector.mesh); },
    .mesh_order = {1.5}};

}  // namespace dovetail::optimizer
