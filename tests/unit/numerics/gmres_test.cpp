#include "numerics/gmres.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <limits>
#include <random>

namespace dovetail::numerics {
namespace {

constexpr Eigen::Index kSize = 40;

Eigen::MatrixXd random_matrix(Eigen::Index rows, Eigen::Index columns, unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return normal(generator); });
}

NearSystem system_of(const Eigen::MatrixXd& a, const Eigen::MatrixXd& near) {
  return {.near_solve = [lu = near.partialPivLu()](const Eigen::VectorXd& b) -> Eigen::VectorXd { return lu.solve(b); },
          .apply = [a](const Eigen::VectorXd& x, const Eigen::VectorXd&) -> Eigen::VectorXd { return a * x; }};
}

TEST(Gmres, TakesOneProductPerDirectionInWhichTheMatricesDiffer) {
  const Eigen::MatrixXd near = random_matrix(kSize, kSize, 1);
  const Eigen::VectorXd b = random_matrix(kSize, 1, 2);
  for (const Eigen::Index rank : {0, 1, 5}) {
    const Eigen::MatrixXd a = near + random_matrix(kSize, rank, 3) * random_matrix(rank, kSize, 4);
    const GmresResult found = gmres(system_of(a, near), b, {.tolerance = 1e-11, .most = 20});
    ASSERT_EQ(found.status, Status::converged);
    EXPECT_EQ(found.products, rank + 1);
    EXPECT_LT((a * found.x - b).norm(), 1e-10 * b.norm());
    EXPECT_LE(found.residual, 1e-11);
  }
}

TEST(Gmres, SaysWhatIsLeftWhereItEndsEarly) {
  const Eigen::MatrixXd near = random_matrix(kSize, kSize, 1), a = near + 0.3 * random_matrix(kSize, kSize, 2);
  const Eigen::VectorXd b = random_matrix(kSize, 1, 3);
  const GmresResult found = gmres(system_of(a, near), b, {.tolerance = 1e-14, .most = 5});
  EXPECT_EQ(found.status, Status::iteration_limit);
  EXPECT_EQ(found.products, 5);
  EXPECT_NEAR((a * found.x - b).norm(), found.residual * b.norm(), 1e-10 * b.norm());
  EXPECT_LT(found.residual, 1);
  EXPECT_EQ(gmres(system_of(a, near), b, {.tolerance = 1e-14, .most = 0}).products, 0);
}

TEST(Gmres, FindsTheWholeSpaceWhereItMay) {
  const Eigen::MatrixXd near = random_matrix(kSize, kSize, 1), a = random_matrix(kSize, kSize, 2);
  const Eigen::VectorXd b = random_matrix(kSize, 1, 3);
  const GmresResult found = gmres(system_of(a, near), b, {.tolerance = 1e-10, .most = 2 * kSize});
  EXPECT_EQ(found.status, Status::converged);
  EXPECT_LE(found.products, kSize);
  EXPECT_LT((a * found.x - b).norm(), 1e-8 * b.norm());
}

// The left null vector of a singular matrix is in b: nothing that is met can make up for it.
TEST(Gmres, ShowsASingularMatrixByItsLeastStretch) {
  const Eigen::MatrixXd near = random_matrix(kSize, kSize, 1);
  const Eigen::VectorXd null = random_matrix(kSize, 1, 2).normalized(), b = random_matrix(kSize, 1, 3);
  for (const double left : {0.0, 1e-9, 0.1}) {
    // Its product with `null` is that of `near`, times `left`.
    const Eigen::MatrixXd a = near - (1 - left) * (near * null) * null.transpose();
    const GmresResult found = gmres(system_of(a, near), b, {.tolerance = 1e-12, .most = 10});
    if (left == 0.1)
      EXPECT_GT(found.least_stretch, 0.001);
    else
      EXPECT_LT(found.least_stretch, 1e-6) << left;
  }
}

TEST(Gmres, EndsAtOnceWithoutRightHandSideOrWithWhatIsNotFinite) {
  const Eigen::MatrixXd near = random_matrix(kSize, kSize, 1);
  const GmresResult none = gmres(system_of(near, near), Eigen::VectorXd::Zero(kSize), {});
  EXPECT_EQ(none.status, Status::converged);
  EXPECT_EQ(none.x, Eigen::VectorXd::Zero(kSize));
  EXPECT_EQ(none.products, 0);
  Eigen::VectorXd wrong = Eigen::VectorXd::Ones(kSize);
  wrong(3) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(gmres(system_of(near, near), wrong, {}).status, Status::not_finite);
  Eigen::MatrixXd broken = near;
  broken(0, 0) = std::numeric_limits<double>::infinity();
  EXPECT_EQ(gmres(system_of(broken, near), Eigen::VectorXd::Ones(kSize), {}).status, Status::not_finite);
}

}  // namespace
}  // namespace dovetail::numerics
