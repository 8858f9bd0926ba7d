#include <gtest/gtest.h>

#include <numbers>

#include "fem/element.hpp"
#include "geometry/mesh/mesh_quality.hpp"

namespace dovetail::geometry {
namespace {

/// The reference wedge under a linear map: an equilateral triangle of side 1, height 2.
fem::Mesh wedge(const Eigen::Matrix3d& map = Eigen::Matrix3d::Identity()) {
  fem::Mesh mesh;
  mesh.kind = fem::ElementKind::wedge18;
  mesh.nodes.resize(3, 18);
  for (int i = 0; i < 18; ++i) {
    const Eigen::Vector3d local = fem::Wedge18::node(i);
    mesh.nodes.col(i) =
        map * Eigen::Vector3d(local.x() + local.y() / 2, std::numbers::sqrt3 / 2 * local.y(), local.z());
    mesh.connectivity.push_back(i);
  }
  mesh.region = {0};
  mesh.regions = {{}};
  return mesh;
}

TEST(WedgeQuality, IsOneForAStraightPrismOfAnyHeight) {
  for (const double height : {0.1, 1.0, 30.0}) {
    const MeshQuality quality = assess(wedge(Eigen::Vector3d(2, 2, height).asDiagonal()));
    EXPECT_NEAR(quality.minimum_scaled_jacobian, 1, 1e-14);
    EXPECT_NEAR(quality.minimum_angle, std::numbers::pi / 3, 1e-14);
    EXPECT_EQ(quality.inverted_elements, 0);
  }
}

TEST(WedgeQuality, IsTheCosineOfAShear) {
  Eigen::Matrix3d shear = Eigen::Matrix3d::Identity();
  shear(0, 2) = 1;  // uprights at 45 degrees
  EXPECT_NEAR(assess(wedge(shear)).minimum_scaled_jacobian, std::numbers::sqrt2 / 2, 1e-14);
}

TEST(WedgeQuality, FindsInversion) {
  EXPECT_EQ(assess(wedge(Eigen::Vector3d(1, 1, -1).asDiagonal())).inverted_elements, 1);
  fem::Mesh folded = wedge();
  folded.nodes(2, 6) = -0.51;  // an upright's middle beyond a quarter of it
  EXPECT_EQ(assess(folded).inverted_elements, 1);
  folded.nodes(2, 6) = -0.49;
  EXPECT_EQ(assess(folded).inverted_elements, 0);
}

TEST(WedgeQuality, MeasuresTheVolumeOfABody) {
  EXPECT_NEAR(measure_of_body(wedge(), 0), std::numbers::sqrt3 / 2, 1e-14);
  EXPECT_EQ(measure_of_body(wedge(), 1), 0);
}

}  // namespace
}  // namespace dovetail::geometry
