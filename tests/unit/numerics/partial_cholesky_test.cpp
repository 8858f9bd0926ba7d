#include "numerics/partial_cholesky.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <csignal>
#include <cstdlib>
#include <limits>
#include <utility>
#include <vector>

#include "numerics/cholmod_view.hpp"

namespace dovetail::numerics {
namespace {

/// Grid of springs (1, and 2 across columns), `side` x `side` points column by column, free on all sides: rigid motion
/// is its null vector. `ground` holds every point, or pushes it away.
Eigen::SparseMatrix<double> grid(int side, double ground) {
  std::vector<Eigen::Triplet<double>> entries;
  const auto spring = [&entries](int a, int b, double stiffness) {
    for (const auto& [i, j] : {std::pair{a, a}, std::pair{b, b}}) entries.emplace_back(i, j, stiffness);
    for (const auto& [i, j] : {std::pair{a, b}, std::pair{b, a}}) entries.emplace_back(i, j, -stiffness);
  };
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i) {
      const int here = j * side + i;
      entries.emplace_back(here, here, ground);
      if (i + 1 < side) spring(here, here + 1, 1);
      if (j + 1 < side) spring(here, here + side, 2);
    }
  Eigen::SparseMatrix<double> matrix(side * side, side * side);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

Eigen::MatrixXd dense_schur(const Eigen::SparseMatrix<double>& a, Eigen::Index border) {
  const Eigen::MatrixXd dense(a);
  const Eigen::Index interior = a.rows() - border;
  const Eigen::MatrixXd coupling = dense.topRightCorner(interior, border);
  return dense.bottomRightCorner(border, border) -
         coupling.transpose() * dense.topLeftCorner(interior, interior).llt().solve(coupling);
}

Eigen::MatrixXd some(Eigen::Index rows, Eigen::Index columns) {
  std::srand(5);
  return Eigen::MatrixXd::Random(rows, columns);
}

// Interiors have condition numbers below 1e3: rounding of 1e-16 times that, with room for sums.
constexpr double kSmall = 1e-12;

/// Held, floating, and pushed away so little that it is indefinite, but positive definite with a column of points held.
class PartialCholeskyOf : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(HeldFloatingAndIndefinite, PartialCholeskyOf, testing::Values(0.5, 0.0, -0.01));

// The same to the last bit in an order that is kept, also after a matrix with another pattern.
TEST(EliminationOrder, IsKeptForAPatternAndFoundAnewForAnother) {
  EliminationOrder kept;
  for (const int side : {16, 16, 12, 16}) {
    const Eigen::SparseMatrix<double> a = grid(side, 0.5);
    PartialCholesky with, without;
    ASSERT_EQ(with.factorise(a, side, &kept), Status::converged);
    ASSERT_EQ(without.factorise(a, side), Status::converged);
    EXPECT_EQ(with.schur(), without.schur()) << side;
  }
  // One entry more is another pattern.
  const Eigen::SparseMatrix<double> a = grid(8, 0.5).triangularView<Eigen::Upper>();
  Eigen::SparseMatrix<double> b = a;
  const auto first = kept.of(a, 8);
  EXPECT_EQ(kept.of(a, 8), first);
  b.coeffRef(3, 40) = 0.1;
  b.makeCompressed();
  const auto second = kept.of(b, 8);
  EXPECT_NE(second, first);
  EXPECT_NE(kept.of(b, 9), second) << "another border";
}

// The order of a fine grid is that of its dissection, which takes less work.
TEST(EliminationOrder, IsTheOneThatTakesLessWork) {
  const auto operations = [](double dissect) {
    const Eigen::SparseMatrix<double> a = grid(160, 0.5).triangularView<Eigen::Upper>();
    return EliminationOrder({.dissect = dissect}).of(a, 320)->common.fl;
  };
  const double by_degree = operations(1e9), best = operations(0);
  EXPECT_LE(best, by_degree);
  EXPECT_EQ(best, operations(0)) << "found again";
}

TEST(EliminationOrder, TakesABorderOfOneAndNothingElse) {
  const Eigen::SparseMatrix<double> one = grid(1, 0.5);
  PartialCholesky cholesky;
  ASSERT_EQ(cholesky.factorise(one, 1), Status::converged);
  EXPECT_NEAR(cholesky.schur()(0, 0), 0.5, kSmall);
}

volatile std::sig_atomic_t met = 0;

// METIS takes SIGTERM for itself while it works.
TEST(EliminationOrder, LeavesTheHandlersOfSignalsAsTheyWere) {
  struct sigaction mine {
  }, before{}, after{};
  mine.sa_handler = [](int) { met = met + 1; };
  mine.sa_flags = SA_RESTART;
  sigaction(SIGTERM, &mine, &before);
  const Eigen::SparseMatrix<double> a = grid(40, 0.5).triangularView<Eigen::Upper>();
  (void)EliminationOrder({.dissect = 0}).of(a, 40);
  sigaction(SIGTERM, nullptr, &after);
  EXPECT_EQ(after.sa_flags & (SA_RESTART | static_cast<int>(SA_RESETHAND)), SA_RESTART);
  for (const int times : {1, 2}) {
    std::raise(SIGTERM);
    EXPECT_EQ(met, times);
  }
  sigaction(SIGTERM, &before, nullptr);
}

TEST_P(PartialCholeskyOf, LeavesTheSchurComplementOfTheDenseFormula) {
  const Eigen::SparseMatrix<double> a = grid(16, GetParam());
  EliminationOrder by_degree({.dissect = 1e9}), dissected({.dissect = 0});
  for (const Eigen::Index border : {16, 37, 250, 256})
    for (EliminationOrder* order : {&by_degree, &dissected}) {
      PartialCholesky cholesky;
      ASSERT_EQ(cholesky.factorise(a, border, order), Status::converged);
      EXPECT_EQ(cholesky.size(), 256);
      EXPECT_EQ(cholesky.border(), border);
      const Eigen::MatrixXd exact = dense_schur(a, border);
      EXPECT_LT((cholesky.schur() - exact).norm(), kSmall * exact.norm()) << border;
      EXPECT_EQ(cholesky.schur(), Eigen::MatrixXd(cholesky.schur().transpose()));
    }
}

TEST_P(PartialCholeskyOf, SolvesWithTheBorderHeldMovedAndFree) {
  const Eigen::SparseMatrix<double> a = grid(16, GetParam());
  const Eigen::Index border = 37, interior = 256 - border;
  PartialCholesky cholesky;
  ASSERT_EQ(cholesky.factorise(a, border), Status::converged);
  for (const Eigen::Index columns : {1, 5, 70}) {  // a vector, a block, more than one block
    const Eigen::MatrixXd b = some(256, columns);
    const Eigen::MatrixXd eliminated = cholesky.eliminate(b);

    Eigen::MatrixXd held = eliminated;
    held.bottomRows(border).setZero();
    held = cholesky.substitute(held);
    EXPECT_EQ(held.bottomRows(border).norm(), 0);
    EXPECT_LT(((a * held - b).topRows(interior)).norm(), kSmall * b.norm());
    // What the border carries is the load condensed onto it.
    EXPECT_LT(((b - a * held) - eliminated).bottomRows(border).norm(), kSmall * b.norm());

    Eigen::MatrixXd moved = Eigen::MatrixXd::Zero(256, columns);
    moved.bottomRows(border) = b.bottomRows(border);
    moved = cholesky.substitute(moved);
    EXPECT_EQ(moved.bottomRows(border), b.bottomRows(border));
    EXPECT_LT((a * moved).topRows(interior).norm(), kSmall * b.norm());
    EXPECT_LT(((a * moved).bottomRows(border) - cholesky.schur() * b.bottomRows(border)).norm(), kSmall * b.norm());

    if (GetParam() == 0.0) continue;  // S is singular
    Eigen::MatrixXd x = eliminated;
    x.bottomRows(border) = cholesky.schur().partialPivLu().solve(eliminated.bottomRows(border));
    x = cholesky.substitute(x);
    EXPECT_LT((a * x - b).norm(), 100 * kSmall * b.norm());  // S adds its own condition
  }
}

TEST(PartialCholesky, RefusesAnInteriorThatIsNotPositiveDefinite) {
  // With 16 points held its smallest eigenvalue is 2 (2 sin(pi / 62))^2 = 0.0205 more than the ground.
  PartialCholesky cholesky;
  EXPECT_EQ(cholesky.factorise(grid(16, -0.0204), 16), Status::converged);
  EXPECT_EQ(cholesky.factorise(grid(16, -0.0206), 16), Status::singular);
  Eigen::SparseMatrix<double> broken = grid(16, 0.5);
  broken.coeffRef(5, 5) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(cholesky.factorise(broken, 16), Status::not_finite);
}

TEST(PartialCholesky, TakesABorderFarBelowZero) {
  Eigen::SparseMatrix<double> a = grid(16, 0.0);
  a.coeffRef(250, 250) -= 1e6;  // beyond the first shift, the mean size of the border's diagonal
  PartialCholesky cholesky;
  ASSERT_EQ(cholesky.factorise(a, 37), Status::converged);
  const Eigen::MatrixXd exact = dense_schur(a, 37);
  EXPECT_LT((cholesky.schur() - exact).norm(), kSmall * exact.norm());
}

TEST(PartialCholesky, TakesBordersOfUnconnectedBodiesAndNone) {
  // Springs of the second half alone: the first half is points without neighbours, some of them in the border.
  const Eigen::Index n = 64;
  Eigen::SparseMatrix<double> ordered = grid(8, 1.0);
  ordered.prune([n](Eigen::Index i, Eigen::Index j, double) { return i == j || (i >= n / 2 && j >= n / 2); });
  Eigen::PermutationMatrix<Eigen::Dynamic> turned(n);
  for (int k = 0; k < n; ++k) turned.indices()(k) = (7 * k) % static_cast<int>(n);
  Eigen::SparseMatrix<double> a(n, n);
  a = ordered.twistedBy(turned);
  for (const Eigen::Index border : {0, 20}) {
    PartialCholesky cholesky;
    ASSERT_EQ(cholesky.factorise(a, border), Status::converged);
    const Eigen::MatrixXd exact = dense_schur(a, border);
    EXPECT_LE((cholesky.schur() - exact).norm(), kSmall * exact.norm());
    if (border > 0) continue;
    const Eigen::MatrixXd b = some(n, 3);
    EXPECT_LT((a * cholesky.substitute(cholesky.eliminate(b)) - b).norm(), kSmall * b.norm());
  }
}

TEST(PartialCholesky, MovesWithItsFactors) {
  const Eigen::SparseMatrix<double> a = grid(6, 1.0);
  PartialCholesky first;
  ASSERT_EQ(first.factorise(a, 6), Status::converged);
  const PartialCholesky second = std::move(first);
  Eigen::MatrixXd r = Eigen::MatrixXd::Zero(36, 1);
  r.bottomRows(6).setOnes();
  EXPECT_LT((a * second.substitute(r)).topRows(30).norm(), kSmall);
}

}  // namespace
}  // namespace dovetail::numerics
