#include "numerics/sparse_product.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace dovetail::numerics {
namespace {

Eigen::SparseMatrix<double> scattered(Eigen::Index rows, Eigen::Index columns, int entries) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> value(-1, 1);
  std::vector<Eigen::Triplet<double>> all;
  for (int i = 0; i < entries; ++i)
    all.emplace_back(static_cast<int>(random() % static_cast<unsigned>(rows)),
                     static_cast<int>(random() % static_cast<unsigned>(columns)), value(random));
  Eigen::SparseMatrix<double> result(rows, columns);
  result.setFromTriplets(all.begin(), all.end());
  return result;
}

// Every number of columns: they are taken in pieces.
TEST(SparseProduct, IsThatOfTheDenseMatrix) {
  const Eigen::SparseMatrix<double, Eigen::RowMajor> a = scattered(50, 30, 200);
  for (Eigen::Index columns = 0; columns < 20; ++columns) {
    const Rows x = Rows::Random(30, columns);
    EXPECT_LE((product(a, x) - Eigen::MatrixXd(a) * x).norm(), 1e-14 * (1 + x.norm())) << columns;
  }
}

TEST(SparseProduct, TakesColumnsOfASymmetricMatrixForRows) {
  Eigen::SparseMatrix<double> a = scattered(40, 40, 150);
  a = Eigen::SparseMatrix<double>(a + Eigen::SparseMatrix<double>(a.transpose()));
  const Eigen::MatrixXd x = Eigen::MatrixXd::Random(40, 11);
  EXPECT_LE((symmetric_product(a, x) - Eigen::MatrixXd(a) * x).norm(), 1e-14 * x.norm());
  // With room left between its columns, too.
  a.reserve(Eigen::VectorXi::Constant(40, 5));
  ASSERT_FALSE(a.isCompressed());
  EXPECT_LE((symmetric_product(a, x) - Eigen::MatrixXd(a) * x).norm(), 1e-14 * x.norm());
}

// Every number of rows, more columns than one block, and empty ones.
TEST(SparseProduct, IsCongruent) {
  Eigen::SparseMatrix<double> a = scattered(1300, 1300, 700);
  a = Eigen::SparseMatrix<double>(a + Eigen::SparseMatrix<double>(a.transpose()));
  for (const Eigen::Index rows : {0, 1, 2, 7, 36, 71}) {
    const Eigen::MatrixXd x = Eigen::MatrixXd::Random(rows, 1300), exact = x * (a * x.transpose());
    const Eigen::MatrixXd found = congruent_by_rows(a, x);
    EXPECT_LE((found - exact).norm(), 1e-14 * exact.norm()) << rows;
    EXPECT_EQ(found, found.transpose());
  }
}

}  // namespace
}  // namespace dovetail::numerics
