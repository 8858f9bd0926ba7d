#include "geometry/exports/stl.hpp"

#include <Eigen/Geometry>
#include <bit>
#include <cstdint>
#include <cstring>

#include "core/errors.hpp"
#include "geometry/profile/key_units.hpp"
#include "geometry/solid/surface.hpp"

namespace dovetail::geometry {
namespace {

static_assert(std::endian::native == std::endian::little, "the format is little endian");

template <class T>
void append(std::string& bytes, T value) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  bytes.append(raw, sizeof(T));
}

void append(std::string& bytes, const Eigen::Vector3d& vector) {
  for (Eigen::Index i = 0; i < 3; ++i) append(bytes, static_cast<float>(vector[i]));
}

}  // namespace

std::string stl(const fem::Mesh& mesh, const std::vector<int>& bodies) {
  if (mesh.kind != fem::ElementKind::wedge18)
    throw InputError({.file = {}, .key = "mesh", .value = "plane", .allowed = "must be in space for an STL file"});
  std::vector<std::array<int, 3>> triangles;
  for (const int body : bodies) {
    const std::vector<std::array<int, 3>> of_body = surface(mesh, body);
    triangles.insert(triangles.end(), of_body.begin(), of_body.end());
  }
  std::string bytes = "dovetail, lengths in mm";  // not "solid": that would mean text
  bytes.resize(80, ' ');
  append(bytes, static_cast<std::uint32_t>(triangles.size()));
  for (const auto& [i, j, k] : triangles) {
    const Eigen::Vector3d a = mesh.nodes.col(i) / kMillimetre, b = mesh.nodes.col(j) / kMillimetre,
                          c = mesh.nodes.col(k) / kMillimetre;
    const Eigen::Vector3d normal = (b - a).cross(c - a).normalized();
    append(bytes, normal);
    append(bytes, a);
    append(bytes, b);
    append(bytes, c);
    append(bytes, std::uint16_t{0});
  }
  return bytes;
}

}  // namespace dovetail::geometry
