#include "geometry/exports/stl.hpp"

#include <Eigen/Geometry>
#include <bit>
#include <cstdint>
#include <cstring>

#include "geometry/exports/millimetres.hpp"

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

std::string stl(std::span<const Triangle> triangles) {
  std::string bytes = "dovetail, lengths in mm";  // not "solid": that would mean text
  bytes.resize(80, ' ');
  append(bytes, static_cast<std::uint32_t>(triangles.size()));
  for (const Triangle& triangle : triangles) {
    const auto& [a, b, c] = triangle;
    const Eigen::Vector3d normal = (b - a).cross(c - a).normalized();
    append(bytes, normal);
    for (const Eigen::Vector3d& corner : triangle) append(bytes, Eigen::Vector3d(kPerMillimetre * corner));
    append(bytes, std::uint16_t{0});
  }
  return bytes;
}

}  // namespace dovetail::geometry
