#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "core/errors.hpp"
#include "numerics/dense_lu.hpp"
#include "numerics/dense_product.hpp"
#include "numerics/fourier.hpp"
#include "numerics/newton.hpp"
#include "numerics/powell.hpp"

namespace dovetail::numerics {
namespace {

TEST(FourierBasis, GoesThereAndBack) {
  const FourierBasis basis(5, 32);
  const Eigen::MatrixXd coefficients = Eigen::MatrixXd::Random(4, 11);
  const Eigen::MatrixXd samples = basis.synthesise(coefficients);
  // Values of O(1), sums of 11 terms: a few units in the last place.
  EXPECT_LT((basis.analyse(samples) - coefficients).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_LT((samples.col(2) - basis.synthesis_table() * coefficients.row(2).transpose()).norm(), 1e-13);
  EXPECT_LT((basis.analysis_table() * samples.col(1) - coefficients.row(1).transpose()).norm(), 1e-13);
  const double tau = 2 * std::numbers::pi * 7 / 32;
  EXPECT_NEAR(basis.at(tau).dot(coefficients.row(3)), samples(7, 3), 1e-13);
  const double step = 1e-6;
  EXPECT_NEAR(basis.derivative_at(0.3)(4), (basis.at(0.3 + step)(4) - basis.at(0.3 - step)(4)) / (2 * step), 1e-8);
}

TEST(FourierBasis, DropsWhatIsAboveItsHarmonics) {
  const FourierBasis wide(10, 64), narrow(3, 64);
  const Eigen::MatrixXd coefficients = Eigen::MatrixXd::Random(1, 21);
  const Eigen::MatrixXd low = narrow.analyse(wide.synthesise(coefficients));
  EXPECT_LT((low - coefficients.leftCols(7)).norm(), 1e-14);
}

TEST(FourierBasis, RefusesAliasing) {
  EXPECT_THROW(FourierBasis(3, 6), InputError);
  EXPECT_THROW(FourierBasis(-1, 6), InputError);
  EXPECT_NO_THROW(FourierBasis(3, 7));
  EXPECT_NO_THROW(FourierBasis(0, 1));
}

TEST(DenseLu, SolvesBothWaysAndEstimatesTheCondition) {
  Eigen::MatrixXd a = Eigen::MatrixXd::Random(30, 30) + 6 * Eigen::MatrixXd::Identity(30, 30);
  const Eigen::MatrixXd b = Eigen::MatrixXd::Random(30, 3);
  const DenseLu lu(a);
  ASSERT_EQ(lu.status(), Status::converged);
  EXPECT_LT((a * lu.solve(b) - b).norm(), 1e-13);
  EXPECT_LT((a.transpose() * lu.solve_transposed(b) - b).norm(), 1e-13);
  const double exact =
      1 / (a.cwiseAbs().colwise().sum().maxCoeff() * a.inverse().cwiseAbs().colwise().sum().maxCoeff());
  // LAPACK's estimate of |A^-1| is a lower bound, rarely off by more than a factor of 3.
  EXPECT_GE(lu.reciprocal_condition(), 0.99 * exact);
  EXPECT_LE(lu.reciprocal_condition(), 3 * exact);
}

TEST(DenseLu, SolvesWithComplexNumbers) {
  const Eigen::MatrixXcd a = Eigen::MatrixXcd::Random(30, 30) + 6 * Eigen::MatrixXcd::Identity(30, 30);
  const Eigen::MatrixXcd b = Eigen::MatrixXcd::Random(30, 3);
  const ComplexLu lu(a);
  EXPECT_LT((a * lu.solve(b) - b).norm(), 1e-13);
  EXPECT_LT((a.transpose() * lu.solve_transposed(b) - b).norm(), 1e-13);
  EXPECT_GT(lu.reciprocal_condition(), 1e-3);
  const Eigen::MatrixXcd real = (Eigen::MatrixXd(2, 2) << 0, 1, 1, 0).finished().cast<std::complex<double>>();
  EXPECT_EQ(ComplexLu(real).determinant_sign(), -1);
}

TEST(DenseLu, SaysWhatIsWrong) {
  EXPECT_EQ(DenseLu(Eigen::MatrixXd::Zero(3, 3)).status(), Status::singular);
  Eigen::MatrixXd bad = Eigen::MatrixXd::Identity(3, 3);
  bad(1, 2) = std::nan("");
  EXPECT_EQ(DenseLu(bad).status(), Status::not_finite);
  EXPECT_EQ(DenseLu(Eigen::MatrixXd(0, 0)).status(), Status::converged);
}

TEST(DenseProduct, AgreesWithEigen) {
  const Eigen::MatrixXd a = Eigen::MatrixXd::Random(5, 7), b = Eigen::MatrixXd::Random(7, 4);
  Eigen::MatrixXd c;
  product(a, b, c);
  EXPECT_LT((c - a * b).norm(), 1e-14);
  const Eigen::MatrixXcd x = Eigen::MatrixXcd::Random(6, 5), y = Eigen::MatrixXcd::Random(6, 3);
  EXPECT_LT((transposed_product(x, y) - x.transpose() * y).norm(), 1e-14);
  EXPECT_LT((product(Eigen::MatrixXcd(x.transpose()), y) - x.transpose() * y).norm(), 1e-14);
}

struct Case {
  std::function<Eigen::VectorXd(const Eigen::VectorXd&)> residual;
  std::function<Eigen::MatrixXd(const Eigen::VectorXd&)> jacobian;
  NewtonStats run(Eigen::VectorXd& x, NewtonParams params = {}) const {
    Eigen::VectorXd at = x;
    return newton({.residual =
                       [&](const Eigen::VectorXd& p) {
                         at = p;
                         return residual(p);
                       },
                   .newton_step =
                       [&](Eigen::VectorXd& step) {
                         const DenseLu lu(jacobian(at));
                         if (lu.status() == Status::converged) step = lu.solve(-residual(at));
                         return lu.status();
                       }},
                  x, params);
  }
};

const Case kArctan{
    [](const Eigen::VectorXd& x) { return Eigen::VectorXd(x.array().atan()); },
    [](const Eigen::VectorXd& x) { return Eigen::MatrixXd((1 + x.array().square()).inverse().matrix().asDiagonal()); }};

TEST(Newton, ConvergesWhereFullStepsDiverge) {
  Eigen::VectorXd x = Eigen::VectorXd::Constant(2, 20.0);
  const NewtonStats stats = kArctan.run(x);
  EXPECT_EQ(stats.status, Status::converged);
  EXPECT_LT(x.norm(), 1e-9);
  EXPECT_LT(stats.iterations, 30);
}

TEST(Newton, KeepsFactorsWhileTheyContract) {
  // x + 0.1 sin x = 1: the slope stays within 10 % of that at the start, so one Jacobian serves to the end.
  int jacobians = 0;
  double slope = 0;
  const auto run = [&](double kept) {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(1);
    Eigen::VectorXd at = x, residual;
    slope = kept;
    jacobians = 0;
    const NewtonStats stats = newton({.residual =
                                          [&](const Eigen::VectorXd& p) {
                                            at = p;
                                            residual = Eigen::VectorXd::Constant(1, p(0) + 0.1 * std::sin(p(0)) - 1);
                                            return residual;
                                          },
                                      .newton_step =
                                          [&](Eigen::VectorXd& step) {
                                            ++jacobians;
                                            slope = 1 + 0.1 * std::cos(at(0));
                                            step = -residual / slope;
                                            return Status::converged;
                                          },
                                      .chord_step =
                                          [&](Eigen::VectorXd& step) {
                                            if (slope == 0) return false;
                                            step = -residual / slope;
                                            return true;
                                          }},
                                     x, {.tolerance = 1e-12});
    EXPECT_EQ(stats.status, Status::converged);
    EXPECT_LT(std::abs(x(0) + 0.1 * std::sin(x(0)) - 1), 1e-12);
    EXPECT_EQ(stats.iterations, jacobians);
    return stats;
  };
  EXPECT_EQ(run(0).iterations, 1);
  EXPECT_GT(run(0).chords, 3);
  // A kept slope of the wrong sign is refused, and the step taken from the point before it.
  EXPECT_EQ(run(-1).iterations, 1);
  // A good one from elsewhere leaves nothing to factorise.
  EXPECT_EQ(run(1.1).iterations, 0);
}

TEST(Newton, CrossesAKink) {
  // x + 0.9 |x| = 1 from the flat side: the slope changes by a factor of 19 on the way.
  const Case kink{
      [](const Eigen::VectorXd& x) { return Eigen::VectorXd(x.array() + 0.9 * x.array().abs() - 1); },
      [](const Eigen::VectorXd& x) { return Eigen::MatrixXd((1 + 0.9 * x.array().sign()).matrix().asDiagonal()); }};
  Eigen::VectorXd x = Eigen::VectorXd::Constant(1, -1e3);
  EXPECT_EQ(kink.run(x).status, Status::converged);
  EXPECT_NEAR(x(0), 1 / 1.9, 1e-9);
}

TEST(Newton, ReportsWhyItStopped) {
  Eigen::VectorXd x = Eigen::VectorXd::Constant(1, 20.0);
  EXPECT_EQ(kArctan.run(x, {.max_iterations = 2}).status, Status::iteration_limit);
  const Case no_root{[](const Eigen::VectorXd& p) { return Eigen::VectorXd(p.array().square() + 1); },
                     [](const Eigen::VectorXd& p) { return Eigen::MatrixXd((2 * p.array()).matrix().asDiagonal()); }};
  x(0) = 3;
  EXPECT_NE(no_root.run(x).status, Status::converged);
  x(0) = 0;
  EXPECT_EQ(no_root.run(x).status, Status::singular);
  x(0) = std::nan("");
  EXPECT_EQ(no_root.run(x).status, Status::not_finite);
}

TEST(Powell, SolvesRosenbrockWithAndWithoutAJacobian) {
  const ResidualFunction residual = [](const Eigen::VectorXd& x) {
    return Eigen::VectorXd(Eigen::Vector2d(10 * (x(1) - x(0) * x(0)), 1 - x(0)));
  };
  const JacobianFunction jacobian = [](const Eigen::VectorXd& x) {
    return Eigen::MatrixXd(Eigen::Matrix2d{{-20 * x(0), 10}, {-1, 0}});
  };
  for (const JacobianFunction& j : {jacobian, JacobianFunction{}}) {
    Eigen::VectorXd x = Eigen::Vector2d(-1.2, 1);
    const PowellStats stats = powell(residual, j, x);
    EXPECT_EQ(stats.status, Status::converged);
    EXPECT_LT((x - Eigen::Vector2d(1, 1)).norm(), 1e-8);
  }
  Eigen::VectorXd bad = Eigen::Vector2d(std::nan(""), 0);
  EXPECT_EQ(powell(residual, jacobian, bad).status, Status::not_finite);
}

}  // namespace
}  // namespace dovetail::numerics
