#include "reduction/free_modes.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <vector>

namespace dovetail::reduction {
namespace {

constexpr int kPoints = 80;

/// Chains of springs side by side that nothing holds but `ground` at every point, point by point.
Eigen::SparseMatrix<double> chains(int count, double ground) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int point = 0; point < kPoints; ++point)
    for (int chain = 0; chain < count; ++chain) {
      const int here = point * count + chain, next = here + count;
      entries.emplace_back(here, here, ground);
      if (point + 1 == kPoints) continue;
      for (const int end : {here, next}) entries.emplace_back(end, end, 1 + chain);
      entries.emplace_back(here, next, -1 - chain);
      entries.emplace_back(next, here, -1 - chain);
    }
  Eigen::SparseMatrix<double> matrix(kPoints * count, kPoints * count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

/// Bodies, and points of each in the border.
struct Floating {
  int bodies, border;
};
class FloatingInverseOf : public testing::TestWithParam<Floating> {
 protected:
  const int bodies_ = GetParam().bodies, border_ = bodies_ * GetParam().border;
  const Eigen::SparseMatrix<double> mass_ =
      2 * Eigen::MatrixXd::Identity(bodies_ * kPoints, bodies_* kPoints).sparseView();
};
// A border below and above where the method changes, and more bodies than directions are asked for at first.
INSTANTIATE_TEST_SUITE_P(Bodies, FloatingInverseOf, testing::Values(Floating{2, 10}, Floating{6, 70}, Floating{9, 60}));

TEST_P(FloatingInverseOf, FreeBodiesLeavesOutTheirRigidMotion) {
  const Eigen::SparseMatrix<double> k = chains(bodies_, 0);
  numerics::PartialCholesky factor;
  ASSERT_EQ(factor.factorise(k, border_), Status::converged);
  const FloatingInverse inverse(factor, mass_);
  ASSERT_EQ(inverse.status(), Status::converged);
  EXPECT_EQ(inverse.negative(), 0);
  const Eigen::MatrixXd& rigid = inverse.rigid_modes();
  ASSERT_EQ(rigid.cols(), bodies_);
  EXPECT_LT((k * rigid).norm(), 1e-11);
  EXPECT_LT((rigid.transpose() * (mass_ * rigid) - Eigen::MatrixXd::Identity(bodies_, bodies_)).norm(), 1e-11);
  std::srand(3);
  const Eigen::MatrixXd load = Eigen::MatrixXd::Random(k.rows(), 2);
  const Eigen::MatrixXd x = inverse.apply(load);
  const Eigen::MatrixXd balanced = load - mass_ * rigid * (rigid.transpose() * load);
  EXPECT_LT((k * x - balanced).norm(), 1e-10 * load.norm());
  EXPECT_LT((rigid.transpose() * (mass_ * x)).norm(), 1e-10 * x.norm());
}

// Pushed away by less and by more than the lift of the Krylov method (some 3e-5 here), by less than a chain is stiff.
TEST_P(FloatingInverseOf, BodiesPushedAwayCountsThem) {
  for (const double ground : {-1e-8, -1e-4}) {
    const Eigen::SparseMatrix<double> k = chains(bodies_, ground);
    numerics::PartialCholesky factor;
    ASSERT_EQ(factor.factorise(k, border_), Status::converged);
    const FloatingInverse inverse(factor, mass_);
    ASSERT_EQ(inverse.status(), Status::converged);
    EXPECT_EQ(inverse.negative(), bodies_) << ground;
    EXPECT_EQ(inverse.rigid_modes().cols(), 0) << ground;
    const Eigen::MatrixXd load = Eigen::MatrixXd::Ones(k.rows(), 1);
    EXPECT_LT((k * inverse.apply(load) - load).norm(), 1e-6 * load.norm()) << ground;
  }
}

}  // namespace
}  // namespace dovetail::reduction
