#include "numerics/sparse_factor.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "numerics/sparse_modes.hpp"

namespace dovetail::numerics {
namespace {

using Complex = std::complex<double>;

/// Five-point Laplacian of a side x side grid with zero boundary; eigenvalues l_i + l_j, l_k = 4 sin^2(k pi / (2 (side
/// + 1))): every pair i != j is double. `twist` multiplies the couplings to the right by e^{i twist}: unitarily
/// similar, Hermitian, the same eigenvalues.
template <class Scalar>
Eigen::SparseMatrix<Scalar> laplacian(int side, Scalar twist) {
  std::vector<Eigen::Triplet<Scalar>> entries;
  const auto at = [side](int i, int j) { return j * side + i; };
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i) {
      entries.emplace_back(at(i, j), at(i, j), Scalar(4));
      if (i + 1 < side) entries.emplace_back(at(i + 1, j), at(i, j), -twist);
      if (j + 1 < side) entries.emplace_back(at(i, j + 1), at(i, j), Scalar(-1));
    }
  Eigen::SparseMatrix<Scalar> lower(side * side, side * side);
  lower.setFromTriplets(entries.begin(), entries.end());
  return Eigen::SparseMatrix<Scalar>(lower.template selfadjointView<Eigen::Lower>());
}

Eigen::VectorXd laplacian_eigenvalues(int side) {
  std::vector<double> values;
  const auto one = [side](int k) { return 4 * std::pow(std::sin(k * std::numbers::pi / (2 * (side + 1))), 2); };
  for (int i = 1; i <= side; ++i)
    for (int j = 1; j <= side; ++j) values.push_back(one(i) + one(j));
  std::sort(values.begin(), values.end());
  return Eigen::Map<Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

template <class Scalar>
Eigen::SparseMatrix<Scalar> identity(Eigen::Index n) {
  Eigen::SparseMatrix<Scalar> matrix(n, n);
  matrix.setIdentity();
  return matrix;
}

template <class Scalar>
void expect_solves(const Eigen::SparseMatrix<Scalar>& a) {
  using Dense = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
  SparseCholesky<Scalar> cholesky;
  ASSERT_EQ(cholesky.factorise(a), Status::converged);
  std::srand(3);
  const Dense exact = Dense::Random(a.rows(), 70);  // more than one block of columns
  const Dense b = a * exact;
  // Condition number below 1e3: rounding 1e-16 times that, with room for sums.
  EXPECT_LT((cholesky.solve(b) - exact).norm(), 1e-12 * exact.norm());
  const Dense every_other = cholesky.solve(b.topRows(a.rows()).middleCols(3, 5));
  EXPECT_LT((every_other - exact.middleCols(3, 5)).norm(), 1e-12 * exact.norm());
  Eigen::Matrix<Scalar, Eigen::Dynamic, 1> x = b.col(2);
  cholesky.solve(x.data(), x.data());
  EXPECT_LT((x - exact.col(2)).norm(), 1e-12 * exact.norm());
}

TEST(SparseCholesky, SolvesRealSystems) {
  expect_solves<double>(laplacian<double>(20, 1.0));
}

TEST(SparseCholesky, SolvesHermitianSystems) {
  expect_solves<Complex>(laplacian<Complex>(20, std::polar(1.0, 0.7)));
}

TEST(SparseCholesky, SolvesForColumnsOfALargerMatrix) {
  const Eigen::SparseMatrix<double> a = laplacian<double>(6, 1.0);
  SparseCholesky<double> cholesky;
  ASSERT_EQ(cholesky.factorise(a), Status::converged);
  const Eigen::MatrixXd padded = Eigen::MatrixXd::Random(40, 5);
  const Eigen::MatrixXd x = cholesky.solve(padded.middleRows(2, 36));
  EXPECT_LT((a * x - padded.middleRows(2, 36)).norm(), 1e-13 * padded.norm());
}

TEST(SparseCholesky, ReusesTheAnalysisForNewValues) {
  Eigen::SparseMatrix<double> a = laplacian<double>(15, 1.0);
  SparseCholesky<double> cholesky;
  cholesky.analyse(a);
  EXPECT_FALSE(cholesky.factorised());
  for (double diagonal : {0.0, 1.0, 5.0}) {
    for (Eigen::Index k = 0; k < a.rows(); ++k) a.coeffRef(k, k) = 4 + diagonal;
    ASSERT_EQ(cholesky.factorise(a), Status::converged);
    const Eigen::VectorXd ones = Eigen::VectorXd::Ones(a.rows());
    EXPECT_LT((cholesky.solve(a * ones) - ones).norm(), 1e-11);
  }
}

TEST(SparseCholesky, TakesTheOrderOfAnother) {
  const Eigen::SparseMatrix<double> one = laplacian<double>(20, 1.0), other = laplacian<double>(20, -0.5);
  SparseCholesky<double> first, second;
  ASSERT_EQ(first.factorise(one), Status::converged);
  second.analyse(other, first);
  ASSERT_EQ(second.factorise(other), Status::converged);
  EXPECT_EQ(second.factor_entries(), first.factor_entries());
  const Eigen::VectorXd exact = Eigen::VectorXd::LinSpaced(other.rows(), -1, 2);
  EXPECT_LT((second.solve(Eigen::MatrixXd(other * exact)) - exact).norm(), 1e-12 * exact.norm());
  // Of nothing, and of another size: its own.
  const Eigen::SparseMatrix<double> small = laplacian<double>(5, 1.0);
  second.analyse(small, first);
  ASSERT_EQ(second.factorise(small), Status::converged);
  second.analyse(other, SparseCholesky<double>());
  ASSERT_EQ(second.factorise(other), Status::converged);
}

TEST(SparseCholesky, ReportsWhatIsNotPositiveDefinite) {
  const Eigen::SparseMatrix<double> a = laplacian<double>(10, 1.0);
  const Eigen::SparseMatrix<double> indefinite = a - 1.0 * identity<double>(100);
  SparseCholesky<double> cholesky;
  EXPECT_EQ(cholesky.factorise(indefinite), Status::singular);
  EXPECT_FALSE(cholesky.factorised());
  EXPECT_EQ(cholesky.factorise(a), Status::converged);  // usable again
  Eigen::SparseMatrix<double> broken = a;
  broken.coeffRef(5, 5) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(cholesky.factorise(broken), Status::not_finite);
}

TEST(SparseCholesky, MovesWithItsFactors) {
  const Eigen::SparseMatrix<double> a = laplacian<double>(5, 1.0);
  SparseCholesky<double> first;
  ASSERT_EQ(first.factorise(a), Status::converged);
  const SparseCholesky<double> second = std::move(first);
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(25);
  EXPECT_LT((second.solve(a * ones) - ones).norm(), 1e-13);
}

TEST(SmallestModes, FindsDoubleEigenvaluesTwice) {
  const Eigen::SparseMatrix<double> a = laplacian<double>(25, 1.0);
  const Modes<double> modes = smallest_modes<double>(a, identity<double>(625), {.count = 20, .tolerance = 1e-11});
  ASSERT_EQ(modes.status, Status::converged);
  const Eigen::VectorXd exact = laplacian_eigenvalues(25).head(20);
  EXPECT_LT(((modes.eigenvalues - exact).array() / exact.array()).abs().maxCoeff(), 1e-10);
  EXPECT_LT((modes.vectors.transpose() * modes.vectors - Eigen::MatrixXd::Identity(20, 20)).norm(), 1e-11);
  const Eigen::MatrixXd residual = a * modes.vectors - modes.vectors * modes.eigenvalues.asDiagonal();
  EXPECT_LT(residual.norm(), 1e-8);
}

TEST(SmallestModes, FindsThoseOfAHermitianProblemOnce) {
  const Eigen::SparseMatrix<Complex> a = laplacian<Complex>(25, std::polar(1.0, 0.7));
  const Modes<Complex> modes = smallest_modes<Complex>(a, identity<Complex>(625), {.count = 12});
  ASSERT_EQ(modes.status, Status::converged);
  const Eigen::VectorXd exact = laplacian_eigenvalues(25).head(12);
  EXPECT_LT(((modes.eigenvalues - exact).array() / exact.array()).abs().maxCoeff(), 1e-10);
}

TEST(SmallestModes, LowersItsShiftBelowNegativeEigenvalues) {
  const double softening = 0.13;  // the smallest eigenvalue is 0.1163
  const Eigen::SparseMatrix<double> a = laplacian<double>(12, 1.0) - softening * identity<double>(144);
  const Modes<double> modes = smallest_modes<double>(a, identity<double>(144), {.count = 5});
  ASSERT_EQ(modes.status, Status::converged);
  EXPECT_LT(modes.shift, modes.eigenvalues[0]);
  const Eigen::VectorXd exact = laplacian_eigenvalues(12).head(5).array() - softening;
  EXPECT_LT((modes.eigenvalues - exact).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(SmallestModes, FindsAllModesOfASmallProblemButOne) {
  const Modes<double> modes = smallest_modes<double>(laplacian<double>(4, 1.0), identity<double>(16), {.count = 15});
  ASSERT_EQ(modes.status, Status::converged);
  EXPECT_LT((modes.eigenvalues - laplacian_eigenvalues(4).head(15)).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(SmallestModes, SaysWhenItsVectorsDoNotSuffice) {
  // 43 vectors for one mode of 10 000 nearly equal ones far from the shift: not to 1e-13.
  const Modes<double> modes =
      smallest_modes<double>(laplacian<double>(100, 1.0), identity<double>(10000),
                             {.count = 1, .shift = -1e4, .tolerance = 1e-13, .vector_limit = 3});
  EXPECT_EQ(modes.status, Status::iteration_limit);
}

/// Diagonal K with the given eigenvalues and M = I / 4: lambda = 4 k.
ShiftInverse<double> diagonal_inverse(const Eigen::VectorXd& stiffness) {
  return {.rows = stiffness.size(), .solve = [&stiffness](const Eigen::MatrixXd& b) {
            return Eigen::MatrixXd(stiffness.cwiseInverse().asDiagonal() * b);
          }};
}

TEST(NearestModes, FindsEveryCopyAndBothSigns) {
  // Fourfold -0.3 and threefold 0.5 among 500 eigenvalues from 1 on: a Krylov space of one vector would hold one of
  // each.
  Eigen::VectorXd stiffness = Eigen::VectorXd::LinSpaced(500, 1, 300);
  stiffness.segment(100, 4).setConstant(-0.3);
  stiffness.segment(300, 3).setConstant(0.5);
  const Eigen::SparseMatrix<double> mass = 0.25 * identity<double>(500);
  for (double tolerance : {1e-6, 1e-11}) {
    const Modes<double> modes = nearest_modes(diagonal_inverse(stiffness), mass, {.count = 8, .tolerance = tolerance});
    ASSERT_EQ(modes.status, Status::converged);
    Eigen::VectorXd exact(8);
    exact << -1.2, -1.2, -1.2, -1.2, 2, 2, 2, 4;
    // The error of an eigenvalue is below the residual, at worst tolerance times lambda.
    EXPECT_LT((modes.eigenvalues - exact).cwiseAbs().maxCoeff(), std::max(1e-12, 4 * tolerance));
    EXPECT_LT((modes.vectors.transpose() * mass * modes.vectors - Eigen::MatrixXd::Identity(8, 8)).norm(), 1e-11);
  }
}

TEST(NearestModes, DoesNotDependOnTheUnits) {
  // 1/lambda is 1e-16 to 1e-13 of what is usual, below the absolute thresholds of the eigen-solver.
  const Eigen::VectorXd stiffness = 1e14 * Eigen::VectorXd::LinSpaced(400, 1, 4000).array().square();
  const Modes<double> modes = nearest_modes(diagonal_inverse(stiffness), identity<double>(400), {.count = 6});
  ASSERT_EQ(modes.status, Status::converged);
  EXPECT_LT((modes.eigenvalues.array() / stiffness.head(6).array() - 1).abs().maxCoeff(), 1e-9);
}

TEST(NearestModes, SaysThatTheSolverReturnsNoNumbers) {
  Eigen::VectorXd stiffness = Eigen::VectorXd::LinSpaced(400, 1, 4000);
  stiffness(7) = std::numeric_limits<double>::quiet_NaN();
  const Modes<double> modes = nearest_modes(diagonal_inverse(stiffness), identity<double>(400), {.count = 6});
  EXPECT_EQ(modes.status, Status::not_finite);
}

TEST(NearestModes, EndsWithinItsApplications) {
  // An operator that never gives the same image twice has no modes: only the bound ends the search.
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int count : {1, 30}) {
    int applied = 0;
    const ShiftInverse<double> noise{.rows = 400, .solve = [&](const Eigen::MatrixXd& b) {
                                       applied += static_cast<int>(b.cols());
                                       Eigen::MatrixXd x(400, b.cols());
                                       for (double& entry : x.reshaped()) entry = uniform(random);
                                       return x;
                                     }};
    const Modes<double> modes = nearest_modes(noise, identity<double>(400), {.count = count, .vector_limit = 3});
    EXPECT_EQ(modes.status, Status::iteration_limit);
    EXPECT_LE(applied, 3 * 3 * count + 400);
  }
}

}  // namespace
}  // namespace dovetail::numerics
