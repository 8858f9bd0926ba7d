#include "geometry/mesh/contact_grid.hpp"

#include <gtest/gtest.h>

namespace dovetail::geometry {
namespace {

TEST(ContactGrid, ReproducesBilinearFields) {
  const std::vector<double> across{0, 0.3, 1}, along{-2, -0.5, 1, 2}, at{0, 0.1, 0.3, 0.7, 1}, z{-2, -1, 1, 1.5, 2};
  const Eigen::SparseMatrix<double> weights = bilinear_interpolation(across, along, at, z);
  ASSERT_EQ(weights.rows(), 25);
  ASSERT_EQ(weights.cols(), 12);
  const auto field = [](double s, double t) { return 1 + 2 * s - t; };  // linear: the same in every cell
  Eigen::VectorXd nodes(12);
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 3; ++i)
      nodes[i + 3 * j] = field(across[static_cast<std::size_t>(i)], along[static_cast<std::size_t>(j)]);
  const Eigen::VectorXd values = weights * nodes;
  for (int l = 0; l < 5; ++l)
    for (int k = 0; k < 5; ++k)
      EXPECT_NEAR(values[k + 5 * l], field(at[static_cast<std::size_t>(k)], z[static_cast<std::size_t>(l)]), 1e-14);
}

TEST(ContactGrid, FollowsAloneTheNodeItIsAt) {
  const Eigen::SparseMatrix<double> weights =
      bilinear_interpolation({0, 0.5, 1}, {0, 1}, {0, 0.5 + 1e-15, 0.75, 1}, {0, 0.5});
  EXPECT_EQ(weights.row(0).sum(), 1);
  EXPECT_EQ(weights.coeff(0, 0), 1);
  EXPECT_EQ(weights.coeff(1, 1), 1);
  EXPECT_EQ(weights.coeff(2, 1), 0.5);
  EXPECT_EQ(weights.coeff(6, 5), 0.25);
  EXPECT_EQ(weights.coeff(7, 2), 0.5);
  EXPECT_EQ(weights.nonZeros(), 1 + 1 + 2 + 1 + 2 * (1 + 1 + 2 + 1));
}

TEST(ContactGrid, OfOneLineIsLinear) {
  const Eigen::SparseMatrix<double> weights = bilinear_interpolation({0, 1}, {0}, {0, 0.25, 1}, {0});
  EXPECT_EQ(weights.rows(), 3);
  EXPECT_EQ(weights.coeff(1, 0), 0.75);
  EXPECT_EQ(weights.coeff(1, 1), 0.25);
}

}  // namespace
}  // namespace dovetail::geometry
