#include "geometry/exports/inp_layer.hpp"

#include <cassert>
#include <numeric>
#include <utility>

#include "geometry/solid/solid_layers.hpp"

namespace dovetail::geometry {

namespace {

constexpr int kHeights = 3;

/// What solid_layers leaves empty.
fem::Flank layer_flank(const fem::Flank& section, std::vector<std::array<int, 2>> pairs_of_layers) {
  const Eigen::Index pairs = section.interpolation.rows(), contact = section.interpolation.cols();
  fem::Flank flank = section;
  flank.pairs = std::move(pairs_of_layers);
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index k = 0; k < section.interpolation.outerSize(); ++k)
    for (Eigen::SparseMatrix<double>::InnerIterator entry(section.interpolation, k); entry; ++entry)
      for (int height = 0; height < kHeights; ++height)
        entries.emplace_back(static_cast<int>(entry.row() + height * pairs), static_cast<int>(entry.col()),
                             entry.value());
  flank.interpolation.resize(kHeights * pairs, contact);
  flank.interpolation.setFromTriplets(entries.begin(), entries.end());
  flank.position = Eigen::MatrixXd::Zero(3, contact);
  flank.position.topRows(2) = section.position;
  flank.normal = Eigen::Vector3d(section.normal[0], section.normal[1], 0);
  flank.tangents = Eigen::MatrixXd::Zero(3, 2);
  flank.tangents.topLeftCorner(2, 1) = section.tangents;
  flank.tangents(2, 1) = 1;
  return flank;
}

}  // namespace

fem::SectorMesh inp_layer(const fem::SectorMesh& section) {
  assert(section.mesh.kind == fem::ElementKind::triangle6 && !section.mesh.regions.empty());
  const int count = section.mesh.node_count();
  fem::SectorMesh layer = solid_layers(section, 1);
  layer.mesh.nodes.resize(3, kHeights * count);
  for (int height = 0; height < kHeights; ++height) {
    layer.mesh.nodes.block(0, height * count, 2, count) = section.mesh.nodes;
    layer.mesh.nodes.row(2)
        .segment(height * count, count)
        .setConstant(0.5 * (height - 1) * section.mesh.regions.front().thickness);
  }
  for (std::size_t f = 0; f < layer.flanks.size(); ++f)
    layer.flanks[f] = layer_flank(section.flanks[f], std::move(layer.flanks[f].pairs));
  layer.axial_nodes.resize(static_cast<std::size_t>(kHeights * count));
  std::iota(layer.axial_nodes.begin(), layer.axial_nodes.end(), 0);
  return layer;
}

}  // namespace dovetail::geometry
