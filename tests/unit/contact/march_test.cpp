#include "contact/march.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "contact/pseudo_penalty.hpp"

namespace dovetail::contact {
namespace {

using numerics::FourierBasis;

// Coefficients of lambda_u [d, K] to the flattened order of the derivative and back to a march.
MarchResult run(const Eigen::MatrixXd& coefficients, const NodeLaw& law, const FourierBasis& basis,
                const MarchOptions& options, bool derivative = false) {
  MarchResult result;
  const Eigen::MatrixXd samples = basis.synthesise(coefficients);
  march(samples, law, options, result);
  if (derivative) differentiate(samples, law, basis, options.slip_return, result);
  return result;
}

struct Mixture {
  const char* name;
  Eigen::Index directions;
  double friction, mean, swing, traction;  // of the normal and tangential predictions
  SlipReturn rule;
};

class MarchDerivative : public testing::TestWithParam<Mixture> {};

TEST_P(MarchDerivative, MatchesFiniteDifferences) {
  const Mixture& mixture = GetParam();
  const FourierBasis basis(3, 64);
  const Eigen::Index d = mixture.directions, k = basis.coefficients();
  const NodeLaw law{.friction = mixture.friction, .tangential_penalty = 1.7, .slip_origin = {0.05, -0.1}};
  const MarchOptions options{.slip_return = mixture.rule, .tolerance = 1e-14};
  std::mt19937 generator(11);
  std::normal_distribution<double> normal;
  int compared = 0;
  for (int sample = 0; sample < 8; ++sample) {
    Eigen::MatrixXd at = Eigen::MatrixXd::NullaryExpr(d, k, [&] { return mixture.traction * normal(generator); });
    at.row(0) *= mixture.swing / mixture.traction;
    at(0, 0) = mixture.mean;
    const MarchResult base = run(at, law, basis, options, true);
    ASSERT_EQ(base.status, Status::converged);
    const auto matrix = [&](const Eigen::MatrixXd& c) {
      return Eigen::VectorXd(basis.analyse(run(c, law, basis, options).force).reshaped());
    };
    Eigen::MatrixXd direction = Eigen::MatrixXd::NullaryExpr(d, k, [&] { return normal(generator); });
    // Central differences: h^2 from the third derivative, 1e-16 / h from rounding: 1e-9 at h = 1e-6.
    const double h = 1e-6;
    const MarchResult plus = run(at + h * direction, law, basis, options),
                      minus = run(at - h * direction, law, basis, options);
    if (plus.state != base.state || minus.state != base.state || plus.periods != base.periods ||
        minus.periods != base.periods)
      continue;  // a kink lies between
    ++compared;
    const Eigen::VectorXd difference = (matrix(at + h * direction) - matrix(at - h * direction)) / (2 * h);
    const Eigen::VectorXd exact = base.force_derivative * direction.reshaped();
    EXPECT_LT((exact - difference).norm(), 1e-7 * (1 + exact.norm()));
    EXPECT_NEAR(base.slip_load_derivative.dot(direction.reshaped()), (plus.slip_load - minus.slip_load) / (2 * h),
                1e-7 * (1 + base.slip_load_derivative.norm()));
    EXPECT_NEAR(base.dissipation_derivative.dot(direction.reshaped()), (plus.dissipation - minus.dissipation) / (2 * h),
                1e-7 * (1 + base.dissipation_derivative.norm()));
  }
  EXPECT_GE(compared, 4);
}

INSTANTIATE_TEST_SUITE_P(
    Mixtures, MarchDerivative,
    testing::Values(Mixture{"PlaneSlip", 2, 0.4, 3, 0.3, 1, SlipReturn::first_order},
                    Mixture{"PlaneLiftOff", 2, 0.4, 0.5, 1, 1, SlipReturn::first_order},
                    Mixture{"PlaneLiftOffSecondOrder", 2, 0.4, 0.5, 1, 1, SlipReturn::second_order},
                    Mixture{"PlaneStick", 2, 5, 9, 0.1, 0.5, SlipReturn::first_order},
                    Mixture{"SpaceSlip", 3, 0.4, 3, 0.3, 1, SlipReturn::first_order},
                    Mixture{"SpaceLiftOff", 3, 0.4, 0.5, 1, 1, SlipReturn::first_order},
                    Mixture{"SpaceSlipSecondOrder", 3, 0.4, 3, 0.3, 1, SlipReturn::second_order},
                    Mixture{"SpaceLiftOffSecondOrder", 3, 0.4, 0.5, 1, 1, SlipReturn::second_order},
                    Mixture{"SpaceFrictionless", 3, 0, 2, 0.3, 1, SlipReturn::first_order},
                    Mixture{"PlaneFrictionless", 2, 0, 2, 0.3, 1, SlipReturn::first_order}),
    [](const testing::TestParamInfo<Mixture>& mixture) { return std::string(mixture.param.name); });

TEST(March, SticksWithoutMarchingTwice) {
  const FourierBasis basis(1, 16);
  Eigen::MatrixXd coefficients(2, 3);
  coefficients << 2, 0, 0, 0.1, 0.3, 0.2;
  const MarchResult result = run(coefficients, {.friction = 0.5, .slip_origin = {0.25, 0}}, basis, {}, true);
  EXPECT_TRUE(result.always_stuck);
  EXPECT_EQ(result.periods, 1);
  EXPECT_TRUE(result.force_derivative.isIdentity(0));
  EXPECT_DOUBLE_EQ(result.slip_end(0), 0.25);
  EXPECT_DOUBLE_EQ(result.force(0, 1), 0.4 - 0.25);
  EXPECT_EQ(result.slip_load, 0);
}

TEST(March, CarriesNothingWhenSeparated) {
  const FourierBasis basis(1, 16);
  Eigen::MatrixXd coefficients(3, 3);
  coefficients << -2, 1, 0, 0.1, 0.3, 0.2, 0, 1, 1;
  const MarchResult result = run(coefficients, {.friction = 0.5}, basis, {}, true);
  EXPECT_TRUE(result.always_separated);
  EXPECT_TRUE(result.force.isZero(0));
  EXPECT_TRUE(result.force_derivative.isZero(0));
  EXPECT_TRUE(result.slip_force.isApprox(basis.synthesise(coefficients)));
  EXPECT_EQ(result.slip_load, 0);
}

TEST(March, KeepsTheDerivativeOfEarlierSlip) {
  // The node slides once while loading up and then sticks: its mean traction still follows lambda_u.
  const FourierBasis basis(1, 32);
  Eigen::MatrixXd coefficients(2, 3);
  coefficients << 1, 0, 0, 2, 0.2, 0;
  const NodeLaw law{.friction = 0.5};
  const MarchResult result = run(coefficients, law, basis, {}, true);
  EXPECT_FALSE(result.always_stuck);
  EXPECT_EQ(result.slip_distance, 0);
  // Slides until the traction of the first sample, its largest, is mu N: lambda = mu N + 0.2 (cos - 1).
  EXPECT_NEAR(basis.analyse(result.force)(1, 0), 0.5 - 0.2, 1e-14);
  // d mean / d mean = 0, d mean / d cosine = -1, d mean / d mean normal = mu. Index k d + r.
  EXPECT_NEAR(result.force_derivative(1, 1), 0, 1e-14);
  EXPECT_NEAR(result.force_derivative(1, 3), -1, 1e-14);
  EXPECT_NEAR(result.force_derivative(1, 0), 0.5, 1e-14);
}

TEST(March, SaysWhenItDoesNotRepeat) {
  const FourierBasis basis(1, 16);
  Eigen::MatrixXd coefficients(3, 3);
  coefficients << 1, 0, 0, 0, 0.51, 0, 0.1, 0, 0.52;
  EXPECT_EQ(run(coefficients, {.friction = 0.5}, basis, {.max_periods = 1}).status, Status::not_periodic);
  EXPECT_EQ(run(coefficients, {.friction = 0.5}, basis, {.periodic = false}).status, Status::converged);
  EXPECT_EQ(run(coefficients, {.friction = 0.5}, basis, {.periodic = false}).periods, 1);
}

TEST(March, ExtrapolatesSlipThatDiesOutSlowly) {
  // Loops of traction that barely exceed the limit slip in a few samples per period and settle in hundreds of periods.
  const FourierBasis basis(2, 64);
  const NodeLaw law{.friction = 0.5};
  std::mt19937 generator(4);
  std::normal_distribution<double> normal;
  int compared = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const SlipReturn rule = trial % 2 == 0 ? SlipReturn::first_order : SlipReturn::second_order;
    const MarchOptions options{.slip_return = rule, .max_periods = 20000, .tolerance = 1e-14};
    Eigen::MatrixXd at = Eigen::MatrixXd::NullaryExpr(3, 5, [&] { return 0.4 * normal(generator); });
    at(0, 0) = 2.5;
    const MarchResult base = run(at, law, basis, options, true);
    if (!base.extrapolated || base.status != Status::converged) continue;
    // Marched again from where it ended, it stays.
    NodeLaw again = law;
    again.slip_origin = base.slip_end;
    const MarchResult repeated = run(at, again, basis, options);
    EXPECT_LT((repeated.force - base.force).cwiseAbs().maxCoeff(), 1e-9);
    const Eigen::MatrixXd direction = Eigen::MatrixXd::NullaryExpr(3, 5, [&] { return normal(generator); });
    const double h = 1e-6;
    const MarchResult plus = run(at + h * direction, law, basis, options),
                      minus = run(at - h * direction, law, basis, options);
    if (plus.state != base.state || minus.state != base.state) continue;
    ++compared;
    const Eigen::VectorXd difference = basis.analyse((plus.force - minus.force) / (2 * h)).reshaped();
    const Eigen::VectorXd exact = base.force_derivative * direction.reshaped();
    // The orbit is known to tolerance / (1 - ratio), up to 1e-10 at ratios of 0.9999: its difference quotient to 1e-4.
    EXPECT_LT((difference - exact).norm(), 1e-4 * (1 + exact.norm())) << trial;
  }
  RecordProperty("compared", compared);
  EXPECT_GE(compared, 3);
}

TEST(March, ComesAsCloseAsAskedWhereSlipDiesOutSlowly) {
  // An extrapolation stirs up slip that dies out at once, beside what it left of the slow one.
  const FourierBasis basis(2, 64);
  const NodeLaw law{.friction = 0.5};
  std::mt19937 generator(7);
  std::normal_distribution<double> normal;
  int compared = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const SlipReturn rule = trial % 2 == 0 ? SlipReturn::first_order : SlipReturn::second_order;
    Eigen::MatrixXd at = Eigen::MatrixXd::NullaryExpr(3, 5, [&] { return 0.4 * normal(generator); });
    at(0, 0) = 2.5;
    const MarchOptions asked{.slip_return = rule, .max_periods = 20000, .tolerance = 1e-8};
    MarchOptions strict = asked;
    strict.tolerance = 1e-14;
    const MarchResult found = run(at, law, basis, asked), exact = run(at, law, basis, strict);
    if (!found.extrapolated || !exact.extrapolated || found.status != Status::converged ||
        exact.status != Status::converged)
      continue;
    ++compared;
    // The ratio of two changes is known to some tens of per cent of 1 - ratio: twice what was asked, of limits below 2.
    EXPECT_LE((found.slip_end - exact.slip_end).norm(), 4e-8) << trial;
  }
  EXPECT_GE(compared, 20);
}

TEST(PseudoPenalty, UsesOneTangentialValuePerNode) {
  const Eigen::VectorXd stiffness = (Eigen::VectorXd(6) << 3, 1, 2, 0, 4, 8).finished();
  const PseudoPenalty penalty = pseudo_penalty(stiffness, 3);
  EXPECT_DOUBLE_EQ(penalty.normal(0), 3);
  EXPECT_DOUBLE_EQ(penalty.tangential(0), 1.5);
  EXPECT_DOUBLE_EQ(penalty.normal(1), 8e-3);
  EXPECT_DOUBLE_EQ(penalty.tangential(1), 6);
  EXPECT_DOUBLE_EQ(pseudo_penalty(stiffness, 3, 7, 9).scaled(0.5).tangential(1), 4.5);
}

}  // namespace
}  // namespace dovetail::contact
