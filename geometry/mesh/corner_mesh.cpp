#include "geometry/mesh/corner_mesh.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "core/errors.hpp"
#include "geometry/mesh/contact_grid.hpp"
#include "geometry/mesh/index.hpp"
#include "geometry/mesh/params.hpp"
#include "geometry/mesh/size_field.hpp"
#include "geometry/mesh/triangulation.hpp"

namespace dovetail::geometry {
namespace {

using Eigen::Vector2d;

bool is_aerofoil(const Edge& e) {
  return e.name.starts_with("aerofoil") && !e.is_arc();
}

/// Fractions between from and to (included) so that every part has the same integral of 1/size.
template <class Point>
std::vector<double> graded_parts(double from, double to, double length, const Point& point, const SizeField& size) {
  constexpr int kSamples = SizeParams{}.samples;
  std::vector<double> integral(kSamples + 1, 0.0);
  const double step = (to - from) / kSamples;
  for (int i = 0; i < kSamples; ++i)
    integral[index(i + 1)] = integral[index(i)] + step * length / size(point(from + (i + 0.5) * step));
  const int parts = std::max(1, static_cast<int>(std::lround(integral.back())));
  std::vector<double> fractions{from};
  for (int k = 1, i = 0; k < parts; ++k) {
    const double target = integral.back() * k / parts;
    while (integral[index(i + 1)] < target) ++i;
    const double inside = (target - integral[index(i)]) / (integral[index(i + 1)] - integral[index(i)]);
    fractions.push_back(from + (i + inside) * step);
  }
  fractions.push_back(to);
  return fractions;
}

const Chain& finite(const Chain& chain) {
  for (const Edge& e : chain)
    if (!std::isfinite(e.length()) || !e.start.allFinite())
      throw InputError({.file = {}, .key = "profile", .value = e.name, .allowed = "must be of finite length"});
  return chain;
}

class Builder {
 public:
  Builder(const Chain& chain, const MeshSizes& sizes, const std::vector<double>& flank)
      : chain_(finite(chain)),
        sizes_(sizes),
        flank_(flank),
        size_(element_sizes(chain_, sizes, flank)),
        edges_(static_cast<int>(chain.size())) {
    assert(edges_ % 2 == 0);
  }

  CornerMesh run() {
    divide();
    number_boundary();
    const int foot = edges_ / 2 - 1;  // the aerofoil's right side ends at the tip
    if (is_aerofoil(chain_[index(foot)])) {
      const int tip = mesh_aerofoil(foot);
      fill(foot, tip);
    } else {
      fill(edges_ / 2, mesh_.far_middle());
    }
    return std::move(mesh_);
  }

 private:
  int mirror(int e) const { return (edges_ - e) % edges_; }
  bool crosses(int e) const { return e == mirror(e); }

  void divide() {
    mesh_.fractions.resize(index(edges_));
    for (int e = 0; e <= edges_ / 2; ++e) {
      const Edge& edge = chain_[index(e)];
      const auto point = [&edge](double fraction) { return edge.point(fraction); };
      std::vector<double>& right = mesh_.fractions[index(e)];
      if (crosses(e)) {
        const bool tip = e > 0 && is_aerofoil(chain_[index(e - 1)]);
        right = tip ? std::vector{0.5, 1.0} : graded_parts(0.5, 1.0, edge.length(), point, size_);
        std::vector<double> left(right.rbegin(), right.rend());
        for (double& f : left) f = 1 - f;
        right.insert(right.begin(), left.begin(), left.end() - 1);
        continue;
      }
      if (edge.name.starts_with("flank"))
        right = flank_;
      else if (is_aerofoil(edge))
        right = equal_fractions(sizes_.aerofoil_elements);
      else
        right = graded_parts(0, 1, edge.length(), point, size_);
      std::vector<double>& left = mesh_.fractions[index(mirror(e))];
      for (double f : right) left.push_back(1 - f);
      std::reverse(left.begin(), left.end());
    }
  }

  int add(const Vector2d& x) {
    mesh_.nodes.push_back(x);
    return static_cast<int>(mesh_.nodes.size()) - 1;
  }

  /// Adds a node beside the centre line and its mirror image.
  int add_pair(const Vector2d& x) {
    const int right = add(x);
    const int left = add({-x.x(), x.y()});
    pair(right, left);
    return right;
  }

  void pair(int i, int j) {
    mirror_.resize(std::max({mirror_.size(), index(i) + 1, index(j) + 1}), -1);
    mirror_[index(i)] = j;
    mirror_[index(j)] = i;
  }

  void number_boundary() {
    mesh_.edge_nodes.resize(index(edges_));
    for (int e = 0; e < edges_; ++e)
      for (std::size_t k = 0; k + 1 < mesh_.fractions[index(e)].size(); ++k)
        mesh_.edge_nodes[index(e)].push_back(add(chain_[index(e)].point(mesh_.fractions[index(e)][k])));
    for (int e = 0; e < edges_; ++e)
      mesh_.edge_nodes[index(e)].push_back(mesh_.edge_nodes[index((e + 1) % edges_)].front());
    for (int e = 0; e < edges_; ++e) {
      const std::vector<int>&here = mesh_.edge_nodes[index(e)], &there = mesh_.edge_nodes[index(mirror(e))];
      for (std::size_t k = 0; k < here.size(); ++k) pair(here[k], there[here.size() - 1 - k]);
    }
  }

  void add_triangle(int i, int j, int k, int region) {
    mesh_.triangles.push_back({i, j, k});
    mesh_.region.push_back(region);
    mesh_.triangles.push_back({mirror_[index(i)], mirror_[index(k)], mirror_[index(j)]});
    mesh_.region.push_back(region);
  }

  /// Staggered strip between the aerofoil's right side and the centre line. Returns the middle of its first line.
  int mesh_aerofoil(int side_edge) {
    const std::vector<int>& side = mesh_.edge_nodes[index(side_edge)];
    const auto height = [&](double k) {
      const double whole = std::floor(k);
      const double y = mesh_.nodes[index(side[static_cast<std::size_t>(whole)])].y();
      return whole == k ? y : (y + mesh_.nodes[index(side[static_cast<std::size_t>(whole) + 1])].y()) / 2;
    };
    std::vector<int> middle{add({0, height(0)})};
    const int spans = static_cast<int>(side.size()) - 1;
    for (int k = 0; k < spans; ++k) middle.push_back(add({0, height(k + 0.5)}));
    for (int m : middle) pair(m, m);
    middle.push_back(mesh_.far_middle());
    add_triangle(middle[0], side[0], middle[1], 1);
    for (int k = 0; k < spans; ++k) {
      add_triangle(middle[index(k + 1)], side[index(k)], side[index(k + 1)], 1);
      add_triangle(middle[index(k + 1)], side[index(k + 1)], middle[index(k + 2)], 1);
    }
    mesh_.aerofoil_root = {side[0], middle[0], mirror_[index(side[0])]};
    return middle[0];
  }

  /// Triangulates the right half bounded by edges 0 ... last - 1 (and half of edge `last` when that
  /// crosses the centre line) and the centre line below the node `top`; mirrors it.
  void fill(int last, int top) {
    std::vector<int> border;
    for (int e = 0; e <= last; ++e) {
      const std::vector<int>& on = mesh_.edge_nodes[index(e)];
      const std::size_t half = (on.size() - 1) / 2;
      const std::size_t from = e == 0 ? half : 0;
      const std::size_t to = e < last ? on.size() - 1 : (crosses(e) ? half : 1);
      border.insert(border.end(), on.begin() + static_cast<long>(from), on.begin() + static_cast<long>(to));
    }
    border.push_back(top);
    const double upper = mesh_.nodes[index(top)].y(), lower = mesh_.nodes[index(border.front())].y();
    const auto point = [&](double f) { return Vector2d(0, upper + f * (lower - upper)); };
    const std::vector<double> line = graded_parts(0, 1, upper - lower, point, size_);
    for (std::size_t k = 1; k + 1 < line.size(); ++k) {
      border.push_back(add(point(line[k])));
      pair(border.back(), border.back());
    }

    std::vector<Vector2d> polygon;
    for (int i : border) polygon.push_back(mesh_.nodes[index(i)]);
    const Triangulation half = triangulate(polygon, size_);
    std::vector<int> node = border;
    for (std::size_t k = polygon.size(); k < half.points.size(); ++k) node.push_back(add_pair(half.points[k]));
    for (const auto& t : half.triangles) add_triangle(node[index(t[0])], node[index(t[1])], node[index(t[2])], 0);
  }

  const Chain& chain_;
  const MeshSizes& sizes_;
  const std::vector<double>& flank_;
  SizeField size_;
  int edges_;
  CornerMesh mesh_;
  std::vector<int> mirror_;
};

}  // namespace

int CornerMesh::far_middle() const {
  const std::vector<int>& far = edge_nodes[edge_nodes.size() / 2];
  return far[far.size() / 2];
}

Prescribed prescribed_nodes(const CornerMesh& mesh, const Chain& chain) {
  assert(chain.size() == mesh.edge_nodes.size());
  Prescribed result;
  std::vector<Vector2d> positions;
  for (std::size_t e = 0; e < chain.size(); ++e)
    for (std::size_t k = 0; k + 1 < mesh.fractions[e].size(); ++k) {
      result.nodes.push_back(mesh.edge_nodes[e][k]);
      positions.push_back(chain[e].point(mesh.fractions[e][k]));
    }
  if (!mesh.aerofoil_root.empty()) {
    const std::size_t tip = chain.size() / 2;
    result.nodes.push_back(mesh.aerofoil_root[1]);
    positions.push_back((chain[tip - 1].start + chain[tip + 1].end) / 2);
  }
  result.positions.resize(2, static_cast<Eigen::Index>(positions.size()));
  for (std::size_t k = 0; k < positions.size(); ++k) result.positions.col(static_cast<Eigen::Index>(k)) = positions[k];
  return result;
}

CornerMesh mesh_corners(const Chain& chain, const MeshSizes& sizes, const std::vector<double>& flank) {
  return Builder(chain, sizes, flank).run();
}

}  // namespace dovetail::geometry
