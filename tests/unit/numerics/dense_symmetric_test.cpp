#include "numerics/dense_symmetric.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdlib>
#include <vector>

#include "numerics/dense_general.hpp"

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

TEST(DenseSymmetric, FindsAllPairsOfRealAndHermitianMatrices) {
  const Example example;
  const SymmetricPairs pairs = all_pairs<double>(example.matrix.triangularView<Eigen::Lower>());
  ASSERT_EQ(pairs.status, Status::converged);
  EXPECT_LE((pairs.values - example.values).norm(), kRounding);
  EXPECT_LE((example.matrix * pairs.vectors - pairs.vectors * pairs.values.asDiagonal()).norm(), kRounding);
  // e^{i (k - l)} A_kl has the same eigenvalues.
  const Eigen::VectorXcd turn = (Eigen::VectorXcd::LinSpaced(10, 0, 9) * std::complex<double>(0, 1)).array().exp();
  const Eigen::MatrixXcd turned = turn.asDiagonal() * example.matrix * turn.conjugate().asDiagonal();
  const Pairs<std::complex<double>> complex = all_pairs<std::complex<double>>(turned);
  EXPECT_LE((complex.values - example.values).norm(), kRounding);
  EXPECT_LE((turned * complex.vectors - complex.vectors * complex.values.asDiagonal()).norm(), kRounding);
  EXPECT_EQ(all_pairs<double>(Eigen::MatrixXd()).status, Status::converged);
  EXPECT_EQ(all_pairs<double>(Eigen::MatrixXd::Constant(2, 2, std::nan(""))).status, Status::not_finite);
}

TEST(DenseSymmetric, FindsPairsOfTwoMatrices) {
  const Example example;
  const Eigen::MatrixXd b = Eigen::VectorXd::LinSpaced(10, 1, 4).asDiagonal();
  const SymmetricPairs pairs = all_pairs<double>(example.matrix, b);
  ASSERT_EQ(pairs.status, Status::converged);
  EXPECT_LE((example.matrix * pairs.vectors - b * pairs.vectors * pairs.values.asDiagonal()).norm(), kRounding);
  EXPECT_LE((pairs.vectors.transpose() * b * pairs.vectors - Eigen::MatrixXd::Identity(10, 10)).norm(), kRounding);
  EXPECT_LE((all_values<double>(example.matrix, b).values - pairs.values).norm(), kRounding);
  const Eigen::VectorXd complex =
      all_values<std::complex<double>>(example.matrix.cast<std::complex<double>>(), b.cast<std::complex<double>>())
          .values;
  EXPECT_LE((complex - pairs.values).norm(), kRounding);
  EXPECT_EQ(all_pairs<double>(b, example.matrix).status, Status::singular);
}

TEST(DenseCholesky, SolvesAndSaysWhatIsNotDefinite) {
  const Example example;
  const Eigen::MatrixXd a = example.matrix + 3 * Eigen::MatrixXd::Identity(10, 10);
  const DenseCholesky cholesky(a.triangularView<Eigen::Lower>());
  ASSERT_EQ(cholesky.status(), Status::converged);
  const Eigen::MatrixXd b = example.vectors.leftCols(3);
  EXPECT_LE((a * cholesky.solve(b) - b).norm(), kRounding);
  // X X^T is the inverse of A for B = 1.
  const Eigen::MatrixXd x = cholesky.times_inverse_upper(Eigen::MatrixXd::Identity(10, 10));
  EXPECT_LE((x * x.transpose() * a - Eigen::MatrixXd::Identity(10, 10)).norm(), kRounding);
  // The estimate is an upper bound, within the ratio of norms of the ratio of eigenvalues, 1/10.
  EXPECT_GT(cholesky.reciprocal_condition(), 0.01);
  EXPECT_LE(cholesky.reciprocal_condition(), 0.1);
  EXPECT_EQ(DenseCholesky(example.matrix).status(), Status::singular);
  EXPECT_EQ(DenseCholesky(example.matrix).reciprocal_condition(), 0);
  EXPECT_EQ(DenseCholesky(Eigen::MatrixXd()).reciprocal_condition(), 1);
}

TEST(DenseGeneral, FindsEigenvaluesOfAMatrixWithoutSymmetry) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 2) / 3).toRotationMatrix();
  Eigen::VectorXcd values = eigenvalues(turn).values;
  ASSERT_EQ(values.size(), 3);
  std::sort(values.begin(), values.end(), [](auto a, auto b) { return a.imag() < b.imag(); });
  EXPECT_LE(std::abs(values(0) - std::polar(1.0, -0.3)), kRounding);
  EXPECT_LE(std::abs(values(1) - 1.0), kRounding);
  EXPECT_LE(std::abs(values(2) - std::polar(1.0, 0.3)), kRounding);
  EXPECT_EQ(eigenvalues(Eigen::MatrixXd::Constant(2, 2, std::nan(""))).status, Status::not_finite);
  EXPECT_EQ(eigenvalues(Eigen::MatrixXd()).values.size(), 0);
}

TEST(DenseGeneral, SolvesWhatHasNoFullRankByTheShortest) {
  const Example example;
  Eigen::VectorXd values = example.values.cwiseAbs();  // one of them is 0
  const Eigen::MatrixXd singular = example.vectors * values.asDiagonal() * example.vectors.transpose();
  const Eigen::MatrixXd expected = example.vectors.col(4), x = least_squares(singular, singular * expected, 1e-12);
  EXPECT_LE((x - expected).norm(), kRounding);
  EXPECT_LE(std::abs(example.vectors.col(2).dot(x.col(0))), kRounding);
  EXPECT_EQ(least_squares(Eigen::MatrixXd(0, 0), Eigen::MatrixXd(0, 2), 1e-12).cols(), 2);
}

TEST(DenseGeneral, KnowsIndependentColumns) {
  const Example example;
  Eigen::MatrixXd columns(10, 4);
  columns << example.vectors.col(0), 2 * example.vectors.col(1), Eigen::VectorXd::Zero(10),
      example.vectors.col(0) - example.vectors.col(1);
  const std::vector<Eigen::Index> kept = independent_columns(columns, 1e-12);
  ASSERT_EQ(kept.size(), 2U);
  EXPECT_EQ(kept.front(), 1);  // the longest
  EXPECT_TRUE(independent_columns(Eigen::MatrixXd(3, 0), 1e-12).empty());
  EXPECT_TRUE(independent_columns(Eigen::MatrixXd::Zero(3, 2), 1e-12).empty());
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
