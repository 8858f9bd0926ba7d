// What pulls at the blade's neck.
#include "fem/neck.hpp"
#include "optimizer/candidate/candidate_result.hpp"
#include "optimizer/responses/response_table.hpp"

namespace dovetail::optimizer {

// Forces that follow from equilibrium know of a mesh in the plane only through its quadratic arcs.
const Response kNeckTension{
    .name = "neck_tension_pa",
    .unit = "Pa",
    .help = "Mean tension across the narrowest width of the blade's neck under the spin-up load.",
    .stage = Stage::model,
    .value =
        [](const Scene& scene, const CandidateResult& result) {
          const double load = scene.loading.speed * scene.loading.speed;
          return load * fem::neck_tension(result.model.mesh.sector, materials(scene)).mean_stress;
        },
    .mesh_order = {.in_plane = 2, .in_space = 1.5}};

}  // namespace dovetail::optimizer
