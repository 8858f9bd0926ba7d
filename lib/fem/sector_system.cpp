#include "fem/sector_system.hpp"

#include <algorithm>
#include <string>

#include "core/errors.hpp"

namespace dovetail::fem {

namespace {

// Thickness of the blade along its flank: of an element with that node.
double flank_thickness(const Mesh& mesh, int node) {
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    if (std::find(mesh.elements[e].begin(), mesh.elements[e].end(), node) != mesh.elements[e].end())
      return mesh.regions[static_cast<std::size_t>(mesh.region[e])].thickness;
  throw InputError(
      {.file = {}, .key = "sector.flanks", .value = std::to_string(node), .allowed = "must be a node of an element"});
}

}  // namespace

ContactSurface contact_surface(const SectorMesh& sector) {
  Eigen::Index count = 0;
  for (const Flank& flank : sector.flanks) count += static_cast<Eigen::Index>(flank.corner_pairs.size());
  ContactSurface surface;
  surface.area = Eigen::VectorXd::Zero(count);
  surface.gap = Eigen::VectorXd::Zero(count);
  surface.position.resize(2, count);
  surface.flank.resize(count);
  Eigen::Index k = 0;
  for (std::size_t f = 0; f < sector.flanks.size(); ++f) {
    const Flank& flank = sector.flanks[f];
    const Eigen::Index nodes = static_cast<Eigen::Index>(flank.corner_pairs.size());
    if (flank.gap.size() != 0 && flank.gap.size() != nodes)
      throw InputError({.file = {},
                        .key = "sector.flanks." + flank.name + ".gap",
                        .value = std::to_string(flank.gap.size()),
                        .allowed = "must have one entry per corner pair"});
    const double thickness = flank_thickness(sector.mesh, flank.corner_pairs.front()[0]);
    for (Eigen::Index i = 0; i < nodes; ++i) {
      surface.position.col(k + i) = sector.mesh.nodes.col(flank.corner_pairs[static_cast<std::size_t>(i)][0]);
      surface.flank[k + i] = static_cast<int>(f);
      if (i == 0) continue;
      const double half = 0.5 * thickness * (surface.position.col(k + i) - surface.position.col(k + i - 1)).norm();
      surface.area[k + i - 1] += half;
      surface.area[k + i] += half;
    }
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
  const Eigen::SparseMatrix<double>& t = system.constraints.transformation;
  system.centrifugal = t.transpose() * centrifugal_load(system.full.mass, sector.mesh);
  system.tip = Eigen::VectorXd::Zero(system.constraints.size());
  if (sector.tip_node >= 0) {
    Eigen::VectorXd unit = Eigen::VectorXd::Zero(t.rows());
    unit[2 * sector.tip_node] = 1;
    system.tip = t.transpose() * unit;
  }
  system.contact = contact_surface(sector);
  return system;
}

Eigen::SparseMatrix<double> stiffness_at_speed(const FullMatrices& full, const Eigen::SparseMatrix<double>& geometric,
                                               double omega) {
  Eigen::SparseMatrix<double> result = full.stiffness;
  result.coeffs() += geometric.coeffs() - omega * omega * full.mass.coeffs();
  return result;
}

}  // namespace dovetail::fem
