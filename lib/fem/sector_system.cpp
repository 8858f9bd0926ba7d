#include "fem/sector_system.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "core/errors.hpp"
#include "fem/stress_aggregate.hpp"

namespace dovetail::fem {

double body_thickness(const Mesh& mesh, int node) {
  if (mesh.dimensions() == 3) return 1;
  const auto found = std::find(mesh.connectivity.begin(), mesh.connectivity.end(), node);
  if (found == mesh.connectivity.end())
    throw InputError(
        {.file = {}, .key = "sector.flanks", .value = std::to_string(node), .allowed = "must be a node of an element"});
  return mesh.region_of(static_cast<int>(found - mesh.connectivity.begin()) / mesh.nodes_per_element()).thickness;
}

ContactSurface contact_surface(const SectorMesh& sector) {
  Eigen::Index count = 0;
  for (const Flank& flank : sector.flanks) count += flank.contact_count();
  ContactSurface surface;
  surface.area.resize(count);
  surface.gap = Eigen::VectorXd::Zero(count);
  surface.position.resize(sector.mesh.dimensions(), count);
  surface.flank.resize(count);
  Eigen::Index k = 0;
  for (std::size_t f = 0; f < sector.flanks.size(); ++f) {
    const Flank& flank = sector.flanks[f];
    const Eigen::Index nodes = flank.contact_count();
    if (flank.gap.size() != 0 && flank.gap.size() != nodes)
      throw InputError({.file = {},
                        .key = "sector.flanks." + flank.name + ".gap",
                        .value = std::to_string(flank.gap.size()),
                        .allowed = "must have one entry per contact node"});
    std::vector<int> blade;
    for (const std::array<int, 2>& pair : flank.pairs) blade.push_back(pair[0]);
    surface.area.segment(k, nodes) = body_thickness(sector.mesh, blade.front()) *
                                     (flank.interpolation.transpose() * boundary_weights(sector.mesh, blade));
    surface.position.middleCols(k, nodes) = flank.position;
    surface.flank.segment(k, nodes).setConstant(static_cast<int>(f));
    if (flank.gap.size() == nodes) surface.gap.segment(k, nodes) = flank.gap;
    k += nodes;
  }
  return surface;
}

SectorSystem build_sector_system(const SectorMesh& sector, std::span<const Material> materials,
                                 const Assembler& assembler, BoreSupport bore) {
  SectorSystem system;
  system.full = assembler.stiffness_and_mass(sector.mesh, materials);
  system.constraints = real_constraints(sector, bore);
  system.stiffness = constrain(system.full.stiffness, system.constraints);
  system.mass = constrain(system.full.mass, system.constraints);
  system.mass.prune(0.0);
  const Eigen::SparseMatrix<double>& t = system.constraints.transformation;
  system.centrifugal = t.transpose() * centrifugal_load(system.full.mass, sector.mesh);
  system.tip = Eigen::VectorXd::Zero(system.constraints.size());
  if (sector.tip_node >= 0) {
    Eigen::VectorXd unit = Eigen::VectorXd::Zero(t.rows());
    unit[system.full.dimensions * sector.tip_node] = 1;
    system.tip = t.transpose() * unit;
  }
  system.contact = contact_surface(sector);
  return system;
}

Eigen::SparseMatrix<double> stiffness_at_speed(const FullMatrices& full, const Eigen::SparseMatrix<double>& geometric,
                                               double omega) {
  Eigen::SparseMatrix<double> result = full.stiffness;
  result.coeffs() += geometric.coeffs();
  // Mass couples equal components only: a column of z has nothing but what acts along the axis.
  Eigen::VectorXd square = Eigen::VectorXd::Constant(result.cols(), omega * omega);
  if (full.dimensions == 3)
    for (Eigen::Index z = 2; z < square.size(); z += 3) square(z) = 0;
  return result - full.mass * square.asDiagonal();
}

}  // namespace dovetail::fem
