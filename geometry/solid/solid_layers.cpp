#include "geometry/solid/solid_layers.hpp"

#include <array>
#include <cassert>
#include <span>

namespace dovetail::geometry {
namespace {

using Pairs = std::vector<std::array<int, 2>>;

/// Copies of node lists at all heights.
class Heights {
 public:
  Heights(int nodes, int layers) : nodes_(nodes), count_(2 * layers + 1) {}

  [[nodiscard]] int middle() const { return nodes_ * (count_ / 2); }
  [[nodiscard]] std::vector<int> repeated(const std::vector<int>& list) const {
    std::vector<int> all;
    for (int l = 0; l < count_; ++l)
      for (const int node : list) all.push_back(node + nodes_ * l);
    return all;
  }
  [[nodiscard]] Pairs repeated(const Pairs& pairs) const {
    Pairs all;
    for (int l = 0; l < count_; ++l)
      for (const auto& [first, second] : pairs) all.push_back({first + nodes_ * l, second + nodes_ * l});
    return all;
  }
  [[nodiscard]] Eigen::VectorXd repeated(const Eigen::VectorXd& values) const { return values.replicate(count_, 1); }
  [[nodiscard]] std::vector<int> in_middle(std::vector<int> list) const {
    for (int& node : list) node += middle();
    return list;
  }

 private:
  int nodes_, count_;
};

}  // namespace

fem::SectorMesh solid_layers(const fem::SectorMesh& plane, int layers) {
  assert(plane.mesh.kind == fem::ElementKind::triangle6);
  const int nodes = plane.mesh.node_count();
  const Heights heights(nodes, layers);
  fem::SectorMesh solid;
  solid.mesh.kind = fem::ElementKind::wedge18;
  solid.mesh.regions = plane.mesh.regions;
  for (int layer = 0; layer < layers; ++layer)
    for (int e = 0; e < plane.mesh.element_count(); ++e) {
      const std::span<const int> triangle = plane.mesh.element(e);
      for (int height = 2 * layer; height <= 2 * layer + 2; ++height)
        for (const int node : triangle) solid.mesh.connectivity.push_back(node + nodes * height);
      solid.mesh.region.push_back(plane.mesh.region[static_cast<std::size_t>(e)]);
    }
  for (const fem::Flank& flank : plane.flanks) {
    fem::Flank swept;
    swept.name = flank.name;
    swept.pairs = heights.repeated(flank.pairs);
    solid.flanks.push_back(std::move(swept));
  }
  solid.cyclic_pairs = heights.repeated(plane.cyclic_pairs);
  solid.bore_nodes = heights.repeated(plane.bore_nodes);
  solid.blade_fillet_nodes = heights.repeated(plane.blade_fillet_nodes);
  solid.disk_fillet_nodes = heights.repeated(plane.disk_fillet_nodes);
  solid.blade_fillet_share = heights.repeated(plane.blade_fillet_share);
  solid.disk_fillet_share = heights.repeated(plane.disk_fillet_share);
  solid.neck_nodes = heights.in_middle(plane.neck_nodes);
  solid.axial_nodes = solid.bore_nodes;
  solid.tip_node = plane.tip_node + heights.middle();
  solid.sectors = plane.sectors;
  return solid;
}

}  // namespace dovetail::geometry
