#pragma once

#include <Eigen/Core>
#include <vector>

#include "optimizer/candidate/candidate_model.hpp"

namespace dovetail::optimizer::testing {

/// The default joint on a mesh that a test can afford; the same plane mesh for a section and for a sector in space.
inline Scene joint(const SceneKind& kind) {
  Scene scene;
  scene.kind = &kind;
  // On a smaller bore the disk's umbrella mode comes next to the blade's first one.
  scene.geometry.bore_radius = 0.16;
  scene.mesh = {.flank_elements = 6,
                .flank_grading = 4,
                .fillet_fraction = 0.7,
                .bulk_size = 12e-3,
                .aerofoil_elements = 6,
                .blend_fraction = 0.8,
                .growth = 0.5};
  scene.solid_mesh.slot_elements = 4;
  scene.solver.harmonics = 3;
  return scene;
}

/// The slot, the blade on it and the force on the blade `factor` times as long.
inline Scene longer(Scene scene, int factor) {
  scene.geometry.slot_length *= factor;
  scene.geometry.chord *= factor;
  scene.solid_mesh.slot_elements *= factor;
  scene.loading.tip_force *= factor;
  return scene;
}

/// steady::Preload of one flank.
struct FlankLoad {
  Eigen::MatrixXd pressure, area;                ///< [across, along the slot] Pa, m^2
  double normal = 0, tangential = 0, axial = 0;  ///< resultants along the flank's normal and tangents, N

  [[nodiscard]] double mean() const { return normal / area.sum(); }
  /// [across] mean along the slot.
  [[nodiscard]] Eigen::VectorXd profile() const {
    return (pressure.array() * area.array()).rowwise().sum() / area.array().rowwise().sum();
  }
  /// [across] in the middle of the slot; along it there is an odd number of nodes.
  [[nodiscard]] Eigen::VectorXd middle() const { return pressure.col(pressure.cols() / 2); }
};

/// Of the nodes from `first` on, `across` times `along` of them; moves `first` behind them.
inline FlankLoad flank_load(const steady::Preload& preload, const Eigen::VectorXd& area, Eigen::Index d,
                            Eigen::Index across, Eigen::Index along, Eigen::Index& first) {
  const Eigen::Index count = across * along;
  FlankLoad load;
  load.pressure = preload.pressure.segment(first, count).reshaped(across, along);
  load.area = area.segment(first, count).reshaped(across, along);
  const Eigen::MatrixXd force = preload.force.segment(d * first, d * count).reshaped(d, count);
  load.normal = force.row(0).sum();
  load.tangential = force.row(1).sum();
  if (d == 3) load.axial = force.row(2).sum();
  first += count;
  return load;
}

inline std::vector<FlankLoad> flank_loads(const fem::SectorMesh& sector, const fem::SectorSystem& system,
                                          const steady::Preload& preload) {
  std::vector<FlankLoad> loads;
  Eigen::Index first = 0;
  for (const fem::Flank& flank : sector.flanks)
    loads.push_back(
        flank_load(preload, system.contact.area, system.full.dimensions, flank.grid[0], flank.grid[1], first));
  return loads;
}

inline std::vector<FlankLoad> flank_loads(const CandidateModel& model) {
  std::vector<FlankLoad> loads;
  Eigen::Index first = 0;
  for (const fem::FlankCells& flank : model.cells.flanks)
    loads.push_back(flank_load(model.preload, model.cells.area, model.cells.position.rows(),
                               std::ssize(flank.across.front()) - 1, std::ssize(flank.across), first));
  return loads;
}

}  // namespace dovetail::optimizer::testing
