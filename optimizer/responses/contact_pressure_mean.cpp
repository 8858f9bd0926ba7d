// What flanks bear on the whole.
#include <algorithm>

#include "optimizer/candidate/candidate_result.hpp"
#include "optimizer/responses/response_table.hpp"

namespace dovetail::optimizer {

namespace {

double mean_pressure(const CandidateModel& model) {
  const fem::ContactCells& surface = model.cells;
  double mean = 0;
  for (int flank = 0; flank < static_cast<int>(model.mesh.sector.flanks.size()); ++flank) {
    double force = 0, area = 0;
    for (Eigen::Index i = 0; i < surface.count(); ++i) {
      if (surface.flank(i) != flank) continue;
      force += model.preload.pressure(i) * surface.area(i);
      area += surface.area(i);
    }
    mean = std::max(mean, force / area);
  }
  return mean;
}

}  // namespace

// Forces that follow from equilibrium know of a mesh in the plane only through its quadratic arcs.
const Response kContactPressureMean{
    .name = "contact_pressure_mean_pa",
    .unit = "Pa",
    .help = "Mean flank pressure under the spin-up load, of the more loaded flank.",
    .stage = Stage::model,
    .value = [](const Scene&, const CandidateResult& result) { return mean_pressure(result.model); },
    .mesh_order = {.in_plane = 2, .in_space = 1.5}};

}  // namespace dovetail::optimizer
