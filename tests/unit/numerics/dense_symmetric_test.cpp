#include "numerics/dense_symmetric.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cstdlib>

namespace dovetail::numerics {
namespace {

/// A matrix with eigenvalues -2, -1, ..., 7 in directions without structure.
struct Example {
  Eigen::VectorXd values = Eigen::VectorXd::LinSpaced(10, -2, 7);
  Eigen::MatrixXd vectors, matrix;
  Example() {
    std::srand(2);
    vectors = Eigen::MatrixXd::Random(10, 10).householderQr().householderQ();
    matrix = vectors * values.asDiagonal() * vectors.transpose();
  }
};

// Norms are near 10, condition numbers below 10.
constexpr double kRounding = 1e-13;

TEST(DenseSymmetric, FindsPairsUpToALimit) {
  const Example example;
  for (const int count : {0, 1, 4, 10}) {
    const SymmetricPairs pairs = pairs_up_to(example.matrix, count - 2.5);
    ASSERT_EQ(pairs.status, Status::converged);
    ASSERT_EQ(pairs.values.size(), count);
    ASSERT_EQ(pairs.vectors.cols(), count);
    EXPECT_LE((pairs.values - example.values.head(count)).norm(), kRounding);
    EXPECT_LE((example.matrix * pairs.vectors - pairs.vectors * pairs.values.asDiagonal()).norm(), kRounding);
    EXPECT_LE((pairs.vectors.transpose() * pairs.vectors - Eigen::MatrixXd::Identity(count, count)).norm(), kRounding);
  }
  EXPECT_EQ(pairs_up_to(example.matrix, -1e3).vectors.cols(), 0);
  EXPECT_EQ(pairs_up_to(Eigen::MatrixXd(), 1).values.size(), 0);
}

TEST(DenseSymmetric, InvertsWhatIsPositiveDefiniteAndRefusesTheRest) {
  const Example example;
  Eigen::MatrixXd matrix = example.matrix + 3 * Eigen::MatrixXd::Identity(10, 10);
  const Eigen::MatrixXd original = matrix;
  matrix.triangularView<Eigen::StrictlyUpper>().setZero();  // is not read
  ASSERT_EQ(invert_positive_definite(matrix), Status::converged);
  EXPECT_LT((matrix * original - Eigen::MatrixXd::Identity(10, 10)).norm(), kRounding);
  Eigen::MatrixXd indefinite = example.matrix;
  EXPECT_EQ(invert_positive_definite(indefinite), Status::singular);
}

}  // namespace
}  // namespace dovetail::numerics
