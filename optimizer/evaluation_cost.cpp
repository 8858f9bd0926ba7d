#include "optimizer/evaluation_cost.hpp"

#include <cmath>

#include "core/errors.hpp"
#include "fem/flank_trace.hpp"
#include "optimizer/candidate/cell_grid.hpp"
#include "optimizer/candidate/matrices.hpp"
#include "optimizer/scene/scene_kind.hpp"
#include "steady/work.hpp"

namespace dovetail::optimizer {
namespace {

/// Fitted to processor seconds and peak memory of evaluations of ready studies with other meshes and harmonics, by one
/// core of a virtual machine (Intel Xeon, OpenBLAS with one thread); tests/unit/studies/evaluation_cost_test.cpp
/// has them. Of the unknowns a power, for factorisations grow faster than the mesh; of contact the root of its
/// operations, for larger problems need fewer Jacobians.
constexpr CostParams kPlane{.base = 0.1,
                            .per_unknown = 1.85e-6,
                            .unknown_power = 1.3,
                            .per_operation = 8.6e-6,
                            .memory = 78e6,
                            .memory_per_unknown = 4.1e3,
                            .memory_power = 1};
constexpr CostParams kSpace{.base = 0.1,
                            .per_unknown = 6e-8,
                            .unknown_power = 1.7,
                            .per_operation = 8.6e-6,
                            .memory = 78e6,
                            .memory_per_unknown = 1.03e3,
                            .memory_power = 1.24};

geometry::MeshedSector meshed(const Scene& reference, const Scene& scene) {
  try {
    return reference.kind->mesher(reference)(scene);
  } catch (const InputError&) {
    return scene.kind->mesher(scene)(scene);
  }
}

}  // namespace

CandidateSizes sizes_foreseen(const Scene& reference, const Scene& scene) {
  const fem::SectorMesh trace = fem::with_trace(meshed(reference, scene).sector);
  const fem::ContactCells cells = fem::contact_cells(trace, cell_grid(scene, trace, cell_lengths(scene)));
  const int dimensions = trace.mesh.dimensions();
  return {.in_space = scene.kind->in_space,
          .unknowns = static_cast<double>(dimensions) * trace.mesh.node_count(),
          .contact_nodes = static_cast<double>(cells.count()),
          .jacobian_operations =
              steady::jacobian_operations(cells.count(), dimensions, scene.solver.harmonics, scene.solver.samples)};
}

Cost cost_foreseen(const CandidateSizes& sizes) {
  const CostParams& params = sizes.in_space ? kSpace : kPlane;
  return {.seconds = params.base + params.per_unknown * std::pow(sizes.unknowns, params.unknown_power) +
                     params.per_operation * std::sqrt(sizes.jacobian_operations),
          .bytes = params.memory + params.memory_per_unknown * std::pow(sizes.unknowns, params.memory_power)};
}

WorkParams work_foreseen(bool in_space) {
  // Of the quickstart on a coarse mesh and at its own, by a run's log of events; in space bars alone were measured.
  constexpr double kVerify = 12, kDescribe = 8, kFiner = 4;
  return {.bars = in_space ? 3.0 : 5.0, .verify = kVerify, .describe = kDescribe, .finer = kFiner};
}

double loads_foreseen(std::span<const LoadCase> cases, Prestress prestress) {
  constexpr double kLater = 0.35;  // the quickstart in eight cases: 0.29 at its start, 0.35 in a search
  // Of a robust study in ten cases of two speeds: fields that say what a preload changes, and such a change.
  constexpr double kFields = 0.45, kChange = 0.65;
  if (cases.empty()) return 1;
  const auto all = static_cast<double>(cases.size());
  const auto first = static_cast<double>(kinds_of_matrices(cases, prestress));
  if (prestress != Prestress::shared) return first + kLater * (all - first);
  const auto preloads = static_cast<double>(kinds_of_matrices(cases, Prestress::own));
  return (1 + kFields) * first + kChange * (preloads - first) + kLater * (all - preloads);
}

}  // namespace dovetail::optimizer
