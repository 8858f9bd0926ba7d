#include "geometry/mesh/mesh_quality.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

namespace dovetail::geometry {
namespace {

/// One element with corners (0, 0), (1, 0), apex and straight sides.
fem::Mesh triangle(double x, double y) {
  fem::Mesh mesh;
  mesh.nodes.resize(2, 6);
  mesh.nodes << 0, 1, x, 0.5, (1 + x) / 2, x / 2, 0, 0, y, 0, y / 2, y / 2;
  mesh.connectivity = {0, 1, 2, 3, 4, 5};
  mesh.region = {0};
  mesh.regions = {{}};
  return mesh;
}

TEST(MeshQuality, IsOneForAnEquilateralTriangle) {
  const MeshQuality quality = assess(triangle(0.5, std::numbers::sqrt3 / 2));
  EXPECT_NEAR(quality.minimum_scaled_jacobian, 1, 1e-14);
  EXPECT_NEAR(quality.minimum_angle, std::numbers::pi / 3, 1e-14);
  EXPECT_NEAR(quality.maximum_angle, std::numbers::pi / 3, 1e-14);
  EXPECT_EQ(quality.inverted_elements, 0);
}

TEST(MeshQuality, MeasuresARightTriangle) {
  // The angle between the two longest sides (1 and sqrt 2) is 45 degrees: 2/sqrt(3) sin 45.
  const MeshQuality quality = assess(triangle(0, 1));
  EXPECT_NEAR(quality.minimum_scaled_jacobian, std::numbers::sqrt2 / std::numbers::sqrt3, 1e-14);
  EXPECT_NEAR(quality.minimum_angle, std::numbers::pi / 4, 1e-14);
  EXPECT_NEAR(quality.maximum_angle, std::numbers::pi / 2, 1e-14);
}

TEST(MeshQuality, FindsInversion) {
  EXPECT_EQ(assess(triangle(0.5, -0.8)).inverted_elements, 1);
  // A mid-side node beyond a quarter of its side folds the element at the nearer corner.
  fem::Mesh folded = triangle(0.5, std::numbers::sqrt3 / 2);
  folded.nodes(0, 3) = 0.24;
  EXPECT_EQ(assess(folded).inverted_elements, 1);
  EXPECT_LT(assess(folded).minimum_scaled_jacobian, 0);
  folded.nodes(0, 3) = 0.26;
  EXPECT_EQ(assess(folded).inverted_elements, 0);
}

TEST(MeshQuality, NeverAcceptsWhatIsNotANumber) {
  fem::Mesh mesh = triangle(0.5, 1);
  mesh.nodes(0, 2) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(acceptable(assess(mesh), MeshLimits{}));
}

}  // namespace
}  // namespace dovetail::geometry
