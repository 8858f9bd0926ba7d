// How narrow the disk is between two slots.
#include "geometry/profile/measures.hpp"
#include "optimizer/candidate/candidate_result.hpp"
#include "optimizer/responses/response_table.hpp"

namespace dovetail::optimizer {

const Response kPostWidth{.name = "post_width_m",
                          .unit = "m",
                          .help = "Narrowest width of the disk post between two slots.",
                          .stage = Stage::model,
                          .value =
                              [](const Scene& scene, const CandidateResult&) {
                                return geometry::measure(geometry::build_profile(scene.geometry), scene.geometry).post;
                              },
                          .mesh_order = {1.5}};

}  // namespace dovetail::optimizer
