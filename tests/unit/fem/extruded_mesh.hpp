#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <functional>
#include <random>
#include <vector>

#include "fem/sector_mesh.hpp"

namespace dovetail::fem::testing {

/// Where a point of the plane mesh goes at the height z.
using Place = std::function<Eigen::Vector3d(const Eigen::Vector2d& point, double z)>;
inline Eigen::Vector3d straight_up(const Eigen::Vector2d& point, double z) {
  return {point.x(), point.y(), z};
}

/// Wedges over a plane mesh between z = 0 and `length`, `layers` of them. Node k of the plane mesh at level l
/// (0 ... 2 layers) is k + n l.
inline Mesh extrude(const Mesh& plane, int layers, double length, const Place& place = straight_up) {
  Mesh mesh;
  mesh.kind = ElementKind::wedge18;
  const int n = plane.node_count(), levels = 2 * layers + 1;
  mesh.nodes.resize(3, n * levels);
  for (int l = 0; l < levels; ++l)
    for (int k = 0; k < n; ++k)
      mesh.nodes.col(k + n * l).head<3>() = place(plane.nodes.col(k), length * l / (levels - 1));
  for (int layer = 0; layer < layers; ++layer)
    for (int e = 0; e < plane.element_count(); ++e) {
      for (int l = 2 * layer; l <= 2 * layer + 2; ++l)
        for (int node : plane.element(e)) mesh.connectivity.push_back(node + n * l);
      mesh.region.push_back(plane.region[static_cast<std::size_t>(e)]);
    }
  mesh.regions = plane.regions;
  return mesh;
}

/// The same of a sector, straight along z. Contact nodes along the slot: one for `contact_rows` = 1 (uniform contact
/// along the slot), otherwise equally spaced rows that are mesh levels of corners (layers a multiple of rows - 1).
inline SectorMesh extrude(const SectorMesh& plane, int layers, double length, int contact_rows) {
  SectorMesh sector;
  sector.mesh = extrude(plane.mesh, layers, length);
  sector.sectors = plane.sectors;
  const int n = plane.mesh.node_count(), levels = 2 * layers + 1;
  for (int l = 0; l < levels; ++l) {
    for (const auto& [left, right] : plane.cyclic_pairs) sector.cyclic_pairs.push_back({left + n * l, right + n * l});
    for (int node : plane.bore_nodes) sector.bore_nodes.push_back(node + n * l);
  }
  if (plane.tip_node >= 0) sector.tip_node = plane.tip_node + n * layers;
  for (const Flank& flat : plane.flanks) {
    Flank flank;
    flank.name = flat.name;
    const int along = flat.grid[0];
    flank.grid = {along, contact_rows};
    flank.position.resize(3, flank.contact_count());
    flank.gap.resize(flank.contact_count());
    for (int j = 0; j < contact_rows; ++j)
      for (int i = 0; i < along; ++i) {
        const double z = contact_rows == 1 ? length / 2 : length * j / (contact_rows - 1);
        flank.position.col(i + along * j).head<3>() = Eigen::Vector3d(flat.position(0, i), flat.position(1, i), z);
        flank.gap[i + along * j] = flat.gap[i];
      }
    const Eigen::SparseMatrix<double, Eigen::RowMajor> across = flat.interpolation;
    std::vector<Eigen::Triplet<double>> weights;
    for (int l = 0; l < levels; ++l)
      for (std::size_t p = 0; p < flat.pairs.size(); ++p) {
        const int row = static_cast<int>(flank.pairs.size());
        flank.pairs.push_back({flat.pairs[p][0] + n * l, flat.pairs[p][1] + n * l});
        const double place = static_cast<double>(l) * (contact_rows - 1) / (levels - 1);
        const int lower = std::min(static_cast<int>(place), std::max(contact_rows - 2, 0));
        const double share = place - lower;
        for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator w(across, static_cast<Eigen::Index>(p)); w;
             ++w) {
          const int column = static_cast<int>(w.col()) + along * lower;
          if (share < 1) weights.emplace_back(row, column, w.value() * (1 - share));
          if (share > 0) weights.emplace_back(row, column + along, w.value() * share);
        }
      }
    flank.interpolation.resize(static_cast<Eigen::Index>(flank.pairs.size()), flank.contact_count());
    flank.interpolation.setFromTriplets(weights.begin(), weights.end());
    flank.normal = Eigen::Vector3d(flat.normal[0], flat.normal[1], 0);
    flank.tangents = Eigen::MatrixXd::Zero(3, 2);
    flank.tangents.col(0).head<2>() = flat.tangents.col(0);
    flank.tangents(2, 1) = 1;
    sector.flanks.push_back(flank);
  }
  return sector;
}

/// Every node held axially: plane strain.
inline void hold_axially(SectorMesh& sector) {
  sector.axial_nodes.clear();
  for (int node = 0; node < sector.mesh.node_count(); ++node) sector.axial_nodes.push_back(node);
}

/// Moves nodes that are not on the surface of the box [0,1] x [0,1] x [0, length] at random: all edges bend.
inline void shake(Mesh& mesh, double amount, double length, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shift(-amount, amount);
  for (int k = 0; k < mesh.node_count(); ++k) {
    const Eigen::Vector3d x = mesh.nodes.col(k);
    if (x.minCoeff() < 1e-9 || x.x() > 1 - 1e-9 || x.y() > 1 - 1e-9 || x.z() > length - 1e-9) continue;
    for (int c = 0; c < 3; ++c) mesh.nodes(c, k) += shift(random);
  }
}

}  // namespace dovetail::fem::testing
