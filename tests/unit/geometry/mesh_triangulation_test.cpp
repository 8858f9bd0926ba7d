#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "core/errors.hpp"
#include "geometry/mesh/triangulation.hpp"

namespace dovetail::geometry {
namespace {

using Eigen::Vector2d;

/// The unit square with sides in `parts` pieces, finer towards the origin where `power` > 1.
std::vector<Vector2d> square(int parts, double power = 1) {
  std::vector<Vector2d> points;
  const auto part = [&](int i) { return std::pow(static_cast<double>(i) / parts, power); };
  for (int i = 0; i < parts; ++i) points.emplace_back(part(i), 0);
  for (int i = 0; i < parts / 2; ++i) points.emplace_back(1, 2.0 * i / parts);
  for (int i = 0; i < parts / 2; ++i) points.emplace_back(1 - 2.0 * i / parts, 1);
  for (int i = parts; i > 0; --i) points.emplace_back(0, part(i));
  return points;
}

struct Figures {
  double area = 0, smallest_angle = std::numbers::pi;
  std::map<std::pair<int, int>, int> sides;
};

Figures figures(const Triangulation& mesh) {
  Figures result;
  for (const auto& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector2d a = mesh.points[static_cast<std::size_t>(t[i])];
      const Vector2d u = mesh.points[static_cast<std::size_t>(t[(i + 1) % 3])] - a;
      const Vector2d v = mesh.points[static_cast<std::size_t>(t[(i + 2) % 3])] - a;
      const double cross = u.x() * v.y() - u.y() * v.x();
      EXPECT_GT(cross, 0);
      result.area += cross / 6;
      result.smallest_angle = std::min(result.smallest_angle, std::atan2(cross, u.dot(v)));
      ++result.sides[std::minmax(t[i], t[(i + 1) % 3])];
    }
  }
  return result;
}

TEST(Triangulation, FillsASquareWithoutTouchingItsBoundary) {
  const std::vector<Vector2d> boundary = square(20);
  SizeField size(0.1, 0.25);
  for (int i = 0; i <= 20; ++i) {
    size.add_source({i / 20.0, 0}, 0.05);
    size.add_source({0, i / 20.0}, 0.05);
  }
  const Triangulation mesh = triangulate(boundary, size);
  const Figures found = figures(mesh);
  EXPECT_NEAR(found.area, 1, 1e-13);
  EXPECT_GT(found.smallest_angle, 25 * std::numbers::pi / 180);
  const int walls = static_cast<int>(boundary.size());
  for (int i = 0; i < walls; ++i) {
    EXPECT_EQ(mesh.points[static_cast<std::size_t>(i)], boundary[static_cast<std::size_t>(i)]);
    EXPECT_EQ(found.sides.at(std::minmax(i, (i + 1) % walls)), 1);
  }
  EXPECT_EQ(std::count_if(found.sides.begin(), found.sides.end(), [](const auto& side) { return side.second == 1; }),
            walls);
}

TEST(Triangulation, FollowsTheSizeField) {
  SizeField uniform(0.1, 0.25), graded(0.1, 0.25);
  graded.add_source({0, 0}, 0.01);
  const auto count = [&](const SizeField& size, double power) {
    return static_cast<double>(triangulate(square(20, power), size).triangles.size());
  };
  // Triangles of an area A at size h: A / (sqrt(3)/4 h^2) of them; boundary sides finer than h add some.
  const double expected = 1 / (std::numbers::sqrt3 / 4 * 0.1 * 0.1);
  EXPECT_NEAR(count(uniform, 1), expected, 0.4 * expected);
  EXPECT_GT(count(graded, 1.5), 1.2 * count(uniform, 1.5));
}

TEST(Triangulation, RefusesACrossedBoundary) {
  const SizeField size(0.5, 0.25);
  EXPECT_THROW((void)triangulate({{0, 0}, {1, 1}, {1, 0}, {0, 1}}, size), InputError);
  EXPECT_THROW((void)triangulate({{0, 0}, {1, 0}, {1, 0}, {0, 1}}, size), InputError);            // no length
  EXPECT_THROW((void)triangulate({{0, 0}, {1, 0}, {1, 1}, {1, 0.5}, {0, 1}}, size), InputError);  // folded back
  EXPECT_THROW((void)triangulate({{0, 0}, {1, 0}, {std::nan(""), 1}, {0, 1}}, size), InputError);
}

}  // namespace
}  // namespace dovetail::geometry
