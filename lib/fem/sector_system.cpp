#include "fem/sector_system.hpp"

#include <algorithm>
#include <cassert>
#include <string>
#include <utility>
#include <vector>

#include "core/errors.hpp"
#include "fem/stress_aggregate.hpp"

namespace dovetail::fem {

void swap(SectorSystem& a, SectorSystem& b) {
  std::swap(a.full.dimensions, b.full.dimensions);
  a.full.stiffness.swap(b.full.stiffness);
  a.full.mass.swap(b.full.mass);
  a.constraints.transformation.swap(b.constraints.transformation);
  std::swap(a.constraints.internal_count, b.constraints.internal_count);
  std::swap(a.constraints.contact_count, b.constraints.contact_count);
  a.stiffness.swap(b.stiffness);
  a.mass.swap(b.mass);
  a.centrifugal.swap(b.centrifugal);
  a.tip.swap(b.tip);
  std::swap(a.contact, b.contact);
}

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
  // Eigen has no move for sparse matrices; a copy costs as much as the assembly's own pass over the memory.
  SectorSystem system{.full = assembler.stiffness_and_mass(sector.mesh, materials),
                      .constraints = real_constraints(sector, bore),
                      .stiffness = {},
                      .mass = {},
                      .centrifugal = {},
                      .tip = {},
                      .contact = {}};
  constrain(system.full.stiffness, system.constraints).swap(system.stiffness);
  constrain(system.full.mass, system.constraints).swap(system.mass);
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
  // In place: where elements couple masses they couple stiffnesses.
  for (Eigen::Index column = 0; column < result.cols(); ++column) {
    const int first = result.outerIndexPtr()[column];
    const int* row = result.innerIndexPtr() + first;
    double* value = result.valuePtr() + first;
    for (Eigen::SparseMatrix<double>::InnerIterator entry(full.mass, column); entry; ++entry) {
      for (; *row < entry.row(); ++row) ++value;
      assert(*row == entry.row());
      *value -= entry.value() * square(column);
    }
  }
  return result;
}

}  // namespace dovetail::fem
