#include "numerics/nearest_modes.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>
#include "numerics/dense_lu.hpp"
#include "numerics/dense_symmetric.hpp"

namespace dovetail::numerics {
namespace {

using Complex = std::complex<double>;
using Sparse = Eigen::SparseMatrix<double>;

template <class Scalar>
ShiftInverse<Scalar> inverse_of(const Eigen::SparseMatrix<Scalar>& matrix, const LuFactors<Scalar>& lu) {
  return {.rows = matrix.rows(), .solve = [&lu](const Dense<Scalar>& b) -> Dense<Scalar> { return lu.solve(b); }};
}

/// A ring of `count` points around `phase`, spring 1: eigenvalues 2 - 2 cos((2 pi k + phase) / count).
template <class Scalar>
Eigen::SparseMatrix<Scalar> ring(int count, Scalar closing) {
  std::vector<Eigen::Triplet<Scalar>> entries;
  for (int k = 0; k < count; ++k) {
    entries.emplace_back(k, k, Scalar(2));
    const Scalar value = k + 1 < count ? Scalar(-1) : -closing;
    const int next = (k + 1) % count;
    entries.emplace_back(next, k, value);
    entries.emplace_back(k, next, Eigen::numext::conj(value));
  }
  Eigen::SparseMatrix<Scalar> matrix(count, count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

/// K = K1 x I + I x K1 on a torus of 20 x 20 points: eigenvalues of multiplicity up to eight.
Sparse torus(int count) {
  const Sparse one = ring<double>(count, 1.0);
  std::vector<Eigen::Triplet<double>> entries;
  for (int j = 0; j < count; ++j)
    for (Sparse::InnerIterator entry(one, j); entry; ++entry)
      for (int k = 0; k < count; ++k) {
        const int i = static_cast<int>(entry.row());
        entries.emplace_back(i * count + k, j * count + k, entry.value());
        entries.emplace_back(k * count + i, k * count + j, entry.value());
      }
  Sparse matrix(count * count, count * count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

Sparse identity(Eigen::Index size) {
  Sparse matrix(size, size);
  matrix.setIdentity();
  return matrix;
}

// A mass on the pattern of the stiffness stores many zeros, which change nothing.
TEST(NearestModes, StoredZerosOfTheMassDoNotCount) {
  const Sparse mass = identity(400), stiffness = torus(20) + 0.01 * mass;
  Sparse with_zeros = 0.0 * stiffness;
  with_zeros += mass;
  ASSERT_GT(with_zeros.nonZeros(), mass.nonZeros());
  const DenseLu lu{Eigen::MatrixXd(stiffness)};
  const ModesOptions options{.count = 9, .tolerance = 1e-10};
  const Modes<double> plain = nearest_modes(inverse_of<double>(stiffness, lu), mass, options);
  const Modes<double> same = nearest_modes(inverse_of<double>(stiffness, lu), with_zeros, options);
  ASSERT_EQ(same.status, Status::converged);
  EXPECT_EQ(same.eigenvalues, plain.eigenvalues);
  EXPECT_EQ(same.vectors, plain.vectors);
}

TEST(NearestModes, FindsEveryVectorOfMultipleEigenvalues) {
  const Sparse mass = identity(400), stiffness = torus(20) + 0.01 * mass;
  const DenseLu lu{Eigen::MatrixXd(stiffness)};
  const Modes<double> modes = nearest_modes(inverse_of<double>(stiffness, lu), mass, {.count = 29, .tolerance = 1e-10});
  ASSERT_EQ(modes.status, Status::converged);
  std::vector<double> exact;
  const auto value = [](int k) { return 2 - 2 * std::cos(2 * std::numbers::pi * k / 20); };
  for (int i = 0; i < 20; ++i)
    for (int j = 0; j < 20; ++j) exact.push_back(0.01 + value(i) + value(j));
  std::sort(exact.begin(), exact.end());
  ASSERT_EQ(modes.eigenvalues.size(), 29);
  for (int k = 0; k < 29; ++k)
    EXPECT_NEAR(modes.eigenvalues[k], exact[static_cast<std::size_t>(k)], 1e-12 * exact.back()) << k;
  EXPECT_LT((modes.vectors.transpose() * modes.vectors - Eigen::MatrixXd::Identity(29, 29)).norm(), 1e-12);
  // Residuals up to the tolerance, seen through the norm of K against the smallest eigenvalue.
  const Eigen::MatrixXd residual = stiffness * modes.vectors - modes.vectors * modes.eigenvalues.asDiagonal();
  EXPECT_LT(residual.norm(), 1e-7);
}

TEST(NearestModes, FindsModesOnBothSidesOfTheShiftThroughRestarts) {
  // Singular mass: every third point has none. The count is small against what the basis may hold, the tolerance
  // small: it restarts.
  const int size = 300;
  Sparse mass(size, size);
  for (int k = 0; k < size; ++k) mass.insert(k, k) = k % 3 == 0 ? 0.0 : 1.0 + 0.001 * k;
  const double shift = 0.5;
  const Sparse stiffness = ring<double>(size, 0.3), shifted = stiffness - shift * mass;
  const DenseLu lu{Eigen::MatrixXd(shifted)};
  const Modes<double> modes =
      nearest_modes(inverse_of<double>(shifted, lu), mass, {.count = 12, .shift = shift, .tolerance = 1e-12});
  ASSERT_EQ(modes.status, Status::converged);
  // Dense: eigenvalues theta of M^(1/2) (K - sigma M)^{-1} M^(1/2).
  const Eigen::VectorXd root = Eigen::VectorXd(mass.diagonal()).cwiseSqrt();
  const Eigen::MatrixXd flexibility = lu.solve(Eigen::MatrixXd(root.asDiagonal()));
  const Eigen::VectorXd theta = all_values<double>(root.asDiagonal() * flexibility).values;
  std::vector<double> nearest;
  for (double t : theta)
    if (std::abs(t) > 1e-9) nearest.push_back(shift + 1 / t);
  std::sort(nearest.begin(), nearest.end(),
            [&](double a, double b) { return std::abs(a - shift) < std::abs(b - shift); });
  nearest.resize(12);
  std::sort(nearest.begin(), nearest.end());
  for (int k = 0; k < 12; ++k) EXPECT_NEAR(modes.eigenvalues[k], nearest[static_cast<std::size_t>(k)], 1e-11) << k;
  EXPECT_LT(modes.eigenvalues[0], shift);
  EXPECT_GT(modes.eigenvalues[11], shift);
}

TEST(NearestModes, SolvesHermitianProblems) {
  const int size = 256;
  const double phase = 0.7;
  const Eigen::SparseMatrix<Complex> stiffness = ring<Complex>(size, std::polar(1.0, phase));
  Eigen::SparseMatrix<Complex> mass(size, size);
  mass.setIdentity();
  const ComplexLu lu{Eigen::MatrixXcd(stiffness)};
  const Modes<Complex> modes =
      nearest_modes(inverse_of<Complex>(stiffness, lu), mass, {.count = 10, .tolerance = 1e-10});
  ASSERT_EQ(modes.status, Status::converged);
  std::vector<double> exact;
  for (int k = 0; k < size; ++k) exact.push_back(2 - 2 * std::cos((2 * std::numbers::pi * k + phase) / size));
  std::sort(exact.begin(), exact.end());
  for (int k = 0; k < 10; ++k) EXPECT_NEAR(modes.eigenvalues[k], exact[static_cast<std::size_t>(k)], 1e-11) << k;
  EXPECT_LT((modes.vectors.adjoint() * modes.vectors - Eigen::MatrixXcd::Identity(10, 10)).norm(), 1e-11);
}

TEST(NearestModes, ReturnsAllThereIs) {
  // Two points with mass among twenty: two modes, however many are asked for.
  const int size = 20;
  Sparse mass(size, size);
  mass.insert(3, 3) = 1;
  mass.insert(11, 11) = 2;
  const Sparse stiffness = ring<double>(size, 0.5);
  const DenseLu lu{Eigen::MatrixXd(stiffness)};
  const Modes<double> modes = nearest_modes(inverse_of<double>(stiffness, lu), mass, {.count = 5});
  ASSERT_EQ(modes.status, Status::converged);
  EXPECT_EQ(modes.eigenvalues.size(), 2);
  EXPECT_LT((stiffness * modes.vectors - mass * modes.vectors * modes.eigenvalues.asDiagonal()).norm(), 1e-10);
}

TEST(NearestModes, SaysWhenItMayNotGoOnOrMeetsNoNumbers) {
  const Sparse mass = identity(400), stiffness = torus(20) + 0.01 * mass;
  const ShiftInverse<double> broken{
      .rows = 400, .solve = [](const Eigen::MatrixXd& b) { return Eigen::MatrixXd(b * std::nan("")); }};
  EXPECT_EQ(nearest_modes(broken, mass, {.count = 5}).status, Status::not_finite);
  // An operator that is no inverse of anything symmetric: nothing converges.
  int calls = 0;
  const ShiftInverse<double> erratic{.rows = 400, .solve = [&](const Eigen::MatrixXd& b) {
                                       std::srand(static_cast<unsigned>(++calls));
                                       return Eigen::MatrixXd(Eigen::MatrixXd::Random(400, b.cols()));
                                     }};
  EXPECT_EQ(nearest_modes(erratic, mass, {.count = 5, .tolerance = 1e-12}).status, Status::iteration_limit);
}

}  // namespace
}  // namespace dovetail::numerics
