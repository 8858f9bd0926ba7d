#include "geometry/solid/surface.hpp"

#include <algorithm>
#include <cassert>
#include <map>
#include <span>

#include "fem/elements/wedge18.hpp"

namespace dovetail::geometry {
namespace {

using Triangle = std::array<int, 3>;
/// Corners of a face in rising order, the last one -1 for triangles: the same from both sides.
using Key = std::array<int, 4>;

struct Face {
  Key key;
  std::vector<Triangle> triangles;
};

Key key_of(std::span<const int> element, std::array<int, 4> corners) {
  Key key;
  for (std::size_t i = 0; i < 4; ++i) key[i] = corners[i] < 0 ? -1 : element[static_cast<std::size_t>(corners[i])];
  std::sort(key.begin(), key.end());
  return key;
}

Triangle nodes(std::span<const int> element, int a, int b, int c) {
  return {element[static_cast<std::size_t>(a)], element[static_cast<std::size_t>(b)],
          element[static_cast<std::size_t>(c)]};
}

/// The five faces of a wedge.
std::vector<Face> faces(std::span<const int> element) {
  std::vector<Face> list;
  for (const int end : {0, 12}) {
    Face face{.key = key_of(element, {end, end + 1, end + 2, -1}), .triangles = {}};
    for (const auto& [a, b, c] : fem::Triangle6::simplices())
      face.triangles.push_back(end == 0 ? nodes(element, a, c, b) : nodes(element, end + a, end + b, end + c));
    list.push_back(std::move(face));
  }
  for (const std::array<int, 9>& side : fem::Wedge18::sides()) {
    Face face{.key = key_of(element, {side[0], side[2], side[6], side[8]}), .triangles = {}};
    for (const std::size_t corner : {0U, 1U, 3U, 4U}) {
      face.triangles.push_back(nodes(element, side[corner], side[corner + 1], side[corner + 4]));
      face.triangles.push_back(nodes(element, side[corner], side[corner + 4], side[corner + 3]));
    }
    list.push_back(std::move(face));
  }
  return list;
}

}  // namespace

std::vector<Triangle> surface(const fem::Mesh& mesh, int body) {
  assert(mesh.kind == fem::ElementKind::wedge18);
  std::map<Key, int> uses;
  std::vector<Face> all;
  for (int e = 0; e < mesh.element_count(); ++e) {
    if (mesh.region_of(e).body != body) continue;
    for (Face& face : faces(mesh.element(e))) {
      ++uses[face.key];
      all.push_back(std::move(face));
    }
  }
  std::vector<Triangle> triangles;
  for (const Face& face : all)
    if (uses.at(face.key) == 1) triangles.insert(triangles.end(), face.triangles.begin(), face.triangles.end());
  return triangles;
}

}  // namespace dovetail::geometry
