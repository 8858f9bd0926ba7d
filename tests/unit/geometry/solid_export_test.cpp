#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cstdint>
#include <cstring>
#include <string>

#include "fem/element.hpp"
#include "geometry/exports/vtu.hpp"
#include "tests/unit/geometry/solid_checks.hpp"

namespace dovetail::geometry {
namespace {

/// The values of an inline binary array of the file.
template <class T>
std::vector<T> values_of(const std::string& file, const std::string& name) {
  const std::size_t at = file.find("Name=\"" + name + "\"");
  const std::size_t from = file.find('>', at) + 1;
  std::string bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : file.substr(from, file.find('<', from) - from)) {
    if (c == '=') break;
    const std::size_t digit = std::string("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/").find(c);
    bits = (bits << 6U) | static_cast<std::uint32_t>(digit);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>((bits >> static_cast<unsigned>(count)) & 255U);
  }
  std::uint64_t size = 0;
  std::memcpy(&size, bytes.data(), sizeof(size));
  EXPECT_EQ(size + sizeof(size), bytes.size());
  std::vector<T> values(size / sizeof(T));
  std::memcpy(values.data(), bytes.data() + sizeof(size), size);
  return values;
}

TEST(Vtu, OrdersTheNodesOfAWedgeAsVtkDoes) {
  fem::Mesh mesh;
  mesh.kind = fem::ElementKind::wedge18;
  mesh.nodes.resize(3, 18);
  for (int i = 0; i < 18; ++i) {
    mesh.nodes.col(i) = fem::Wedge18::node(i);
    mesh.connectivity.push_back(i);
  }
  mesh.region = {0};
  mesh.regions = {{}};
  const std::string file = vtu(mesh, {});
  EXPECT_EQ(values_of<std::uint8_t>(file, "types"), std::vector<std::uint8_t>{32});
  const std::vector<std::int64_t> order = values_of<std::int64_t>(file, "connectivity");
  ASSERT_EQ(order.size(), 18u);
  const std::vector<double> points = values_of<double>(file, "Points");
  ASSERT_EQ(points.size(), 54u);
  const auto at = [&](int vtk) {
    const std::size_t node = 3 * static_cast<std::size_t>(order[static_cast<std::size_t>(vtk)]);
    return Eigen::Vector3d(points[node], points[node + 1], points[node + 2]);
  };
  // vtkBiQuadraticQuadraticWedge: corners 0-5 (0, 3 one above the other), middles of these edges, then of these sides.
  const std::vector<std::vector<int>> middles{{0, 1}, {1, 2}, {2, 0}, {3, 4},       {4, 5},       {5, 3},
                                              {0, 3}, {1, 4}, {2, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}};
  for (int corner = 0; corner < 3; ++corner) EXPECT_EQ(at(corner + 3) - at(corner), Eigen::Vector3d(0, 0, 2));
  for (std::size_t k = 0; k < middles.size(); ++k) {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const int corner : middles[k]) mean += at(corner) / static_cast<double>(middles[k].size());
    EXPECT_EQ(at(6 + static_cast<int>(k)), mean) << k;
  }
}

}  // namespace
}  // namespace dovetail::geometry
