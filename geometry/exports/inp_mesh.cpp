#include "geometry/exports/inp_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

#include "geometry/exports/millimetres.hpp"

namespace dovetail::geometry {

namespace {

/// Where the deck's node k stands in our order: CPE6 as it is, C3D15 from the 18 nodes (bottom corners, top corners,
/// bottom edges, top edges, upright edges).
constexpr std::array<int, 6> kTriangle{0, 1, 2, 3, 4, 5};
constexpr std::array<int, 15> kWedge{0, 1, 2, 12, 13, 14, 3, 4, 5, 15, 16, 17, 6, 7, 8};
/// Corners of the faces in the deck's numbering of faces, our numbering of nodes.
constexpr std::array<std::array<int, 4>, 3> kTriangleFaces{{{0, 1, 0, 1}, {1, 2, 1, 2}, {2, 0, 2, 0}}};
constexpr std::array<std::array<int, 4>, 5> kWedgeFaces{
    {{0, 1, 2, 0}, {12, 13, 14, 12}, {0, 1, 13, 12}, {1, 2, 14, 13}, {2, 0, 12, 14}}};

std::span<const int> node_order(const fem::Mesh& mesh) {
  if (mesh.kind == fem::ElementKind::triangle6) return kTriangle;
  return kWedge;
}
std::span<const std::array<int, 4>> faces(const fem::Mesh& mesh) {
  if (mesh.kind == fem::ElementKind::triangle6) return kTriangleFaces;
  return kWedgeFaces;
}

class MeshText {
 public:
  MeshText(const fem::SectorMesh& sector, bool with_gap)
      : sector_(sector), mesh_(sector.mesh), positions_(kPerMillimetre * sector.mesh.nodes), used_(inp_nodes(mesh_)) {
    if (with_gap) stand_back();
  }

  std::string text() {
    nodes();
    elements();
    node_sets();
    for (const fem::Flank& flank : sector_.flanks)
      for (int side = 0; side < 2; ++side) flank_surface(flank, side);
    return std::move(text_);
  }

 private:
  template <class... Values>
  void line(fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Values>(values)...);
    text_ += '\n';
  }

  void stand_back() {
    for (const fem::Flank& flank : sector_.flanks) {
      if (flank.gap.size() == 0) continue;
      const Eigen::VectorXd gap = flank.interpolation * flank.gap;
      for (std::size_t p = 0; p < flank.pairs.size(); ++p)
        positions_.col(flank.pairs[p][0]) -= kPerMillimetre * gap[static_cast<Eigen::Index>(p)] * flank.normal;
    }
  }

  void nodes() {
    line("*NODE,NSET=ALL");
    for (Eigen::Index n = 0; n < positions_.cols(); ++n)
      if (used_[static_cast<std::size_t>(n)])
        line("{},{:.12g},{:.12g},{:.12g}", n + 1, positions_(0, n), positions_(1, n),
             mesh_.dimensions() == 3 ? positions_(2, n) : 0.0);
  }

  void elements() {
    const std::span<const int> order = node_order(mesh_);
    for (std::size_t r = 0; r < mesh_.regions.size(); ++r) {
      const fem::Region& region = mesh_.regions[r];
      const char* type = mesh_.dimensions() == 3 ? "C3D15" : region.plane_stress ? "CPS6" : "CPE6";
      line("*ELEMENT,TYPE={},ELSET={}", type, inp_name(region.name));
      for (int e = 0; e < mesh_.element_count(); ++e) {
        if (mesh_.region[static_cast<std::size_t>(e)] != static_cast<int>(r)) continue;
        fmt::format_to(std::back_inserter(text_), "{}", e + 1);
        for (std::size_t k = 0; k < order.size(); ++k)
          fmt::format_to(std::back_inserter(text_), ",{}{}", k == 9 ? "\n" : "",
                         mesh_.element(e)[static_cast<std::size_t>(order[k])] + 1);
        text_ += '\n';
      }
    }
    for (int body = 0; body < 2; ++body) {
      bool first = true;
      for (const fem::Region& region : mesh_.regions) {
        // A region may bear its body's name.
        if (region.body != body || inp_name(region.name) == inp_body_name(body)) continue;
        if (std::exchange(first, false)) line("*ELSET,ELSET={}", inp_body_name(body));
        line("{},", inp_name(region.name));
      }
    }
    line("*ELSET,ELSET=ALL");
    for (const fem::Region& region : mesh_.regions) line("{},", inp_name(region.name));
  }

  void node_set(std::string_view name, std::vector<int> nodes) {
    std::erase_if(nodes, [&](int n) { return !used_[static_cast<std::size_t>(n)]; });
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    if (nodes.empty()) return;
    line("*NSET,NSET={}", name);
    for (std::size_t k = 0; k < nodes.size(); ++k)
      fmt::format_to(std::back_inserter(text_), "{},{}", nodes[k] + 1,
                     k + 1 == nodes.size() || k % 10 == 9 ? "\n" : "");
  }

  [[nodiscard]] static std::vector<int> side_of(std::span<const std::array<int, 2>> pairs, std::size_t side) {
    std::vector<int> nodes;
    for (const std::array<int, 2>& pair : pairs) nodes.push_back(pair[side]);
    return nodes;
  }

  void node_sets() {
    node_set("CUT_LEFT", side_of(sector_.cyclic_pairs, 0));
    node_set("CUT_RIGHT", side_of(sector_.cyclic_pairs, 1));
    node_set("BORE", sector_.bore_nodes);
    if (sector_.tip_node >= 0) node_set("TIP", {sector_.tip_node});
    std::vector<int> fillets = sector_.blade_fillet_nodes;
    fillets.insert(fillets.end(), sector_.disk_fillet_nodes.begin(), sector_.disk_fillet_nodes.end());
    node_set("FILLETS", fillets);
    node_set("AXIAL", sector_.axial_nodes);
    std::vector<bool> follows(used_.size(), false);
    for (const std::array<int, 2>& pair : sector_.cyclic_pairs) follows[static_cast<std::size_t>(pair[1])] = true;
    for (const fem::Flank& flank : sector_.flanks) {
      node_set(inp_flank_name(flank, 0), side_of(flank.pairs, 0));
      node_set(inp_flank_name(flank, 1), side_of(flank.pairs, 1));
      for (const std::array<int, 2>& pair : flank.pairs) follows[static_cast<std::size_t>(pair[0])] = true;
    }
    const auto leading = [&](std::vector<int> nodes) {
      std::erase_if(nodes, [&](int n) { return follows[static_cast<std::size_t>(n)]; });
      return nodes;
    };
    node_set("BORE_HELD", leading(sector_.bore_nodes));
    node_set("AXIAL_HELD", leading(sector_.axial_nodes));
  }

  void flank_surface(const fem::Flank& flank, int side) {
    std::vector<bool> on_flank(used_.size(), false);
    for (const std::array<int, 2>& pair : flank.pairs)
      on_flank[static_cast<std::size_t>(pair[static_cast<std::size_t>(side)])] = true;
    line("*SURFACE,NAME={}_FACES,TYPE=ELEMENT", inp_flank_name(flank, side));
    const std::span<const std::array<int, 4>> all = faces(mesh_);
    for (int e = 0; e < mesh_.element_count(); ++e)
      for (std::size_t f = 0; f < all.size(); ++f)
        if (std::all_of(all[f].begin(), all[f].end(), [&](int k) {
              return on_flank[static_cast<std::size_t>(mesh_.element(e)[static_cast<std::size_t>(k)])];
            }))
          line("{},S{}", e + 1, f + 1);
  }

  const fem::SectorMesh& sector_;
  const fem::Mesh& mesh_;
  Eigen::MatrixXd positions_;
  std::vector<bool> used_;
  std::string text_;
};

}  // namespace

std::vector<bool> inp_nodes(const fem::Mesh& mesh) {
  std::vector<bool> used(static_cast<std::size_t>(mesh.node_count()), false);
  const std::span<const int> order = node_order(mesh);
  for (int e = 0; e < mesh.element_count(); ++e)
    for (const int k : order) used[static_cast<std::size_t>(mesh.element(e)[static_cast<std::size_t>(k)])] = true;
  return used;
}

std::string inp_mesh(const fem::SectorMesh& sector, bool with_gap) {
  return MeshText(sector, with_gap).text();
}

std::string inp_name(std::string_view name) {
  std::string result;
  for (const char c : name)
    result += std::isalnum(static_cast<unsigned char>(c)) != 0
                  ? static_cast<char>(std::toupper(static_cast<unsigned char>(c)))
                  : '_';
  return result;
}

std::string inp_body_name(int body) {
  return body == 0 ? "BLADE" : "DISK";
}

std::string inp_flank_name(const fem::Flank& flank, int side) {
  return "FLANK_" + inp_name(flank.name) + "_" + inp_body_name(side);
}

}  // namespace dovetail::geometry
