#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "contact/march.hpp"

namespace dovetail::contact {
namespace {

using numerics::FourierBasis;

MarchResult run(const Eigen::MatrixXd& coefficients, const NodeLaw& law, int samples, SlipReturn rule) {
  const FourierBasis basis(static_cast<int>(coefficients.cols() / 2), samples);
  MarchResult result;
  march(basis.synthesise(coefficients), law, {.slip_return = rule, .tolerance = 1e-13}, result);
  return result;
}

// Under constant normal force N a plane node is a play operator on lambda_u,T = A cos: it dissipates
// 4 mu N (A - mu N) / eps per cycle, exactly so for any number of samples that hits both extremes.
TEST(March, DissipatesLikeAPlayOperator) {
  Eigen::MatrixXd coefficients(2, 3);
  coefficients << 2, 0, 0, 0.7, 3, 0;
  const NodeLaw law{.friction = 0.4, .tangential_penalty = 5};
  for (const int samples : {8, 100, 1024}) {
    const MarchResult result = run(coefficients, law, samples, SlipReturn::first_order);
    const double limit = 0.4 * 2;
    EXPECT_NEAR(law.friction * result.slip_load, 4 * limit * (3 - limit) / 5, 1e-13);
    EXPECT_NEAR(result.slip_distance, 4 * (3 - limit) / 5, 1e-13);
  }
}

// lambda_u,T turning on a circle of radius A with constant mu N = b < A: in the steady state X follows on a circle with
// radius sqrt(A^2 - b^2), so the path is 2 pi sqrt(A^2 - b^2) / eps.
TEST(March, FollowsACircleAtTheOrderOfItsReturn) {
  Eigen::MatrixXd coefficients(3, 3);
  coefficients << 1, 0, 0, 0, 2, 0, 0, 0, 2;
  const NodeLaw law{.friction = 0.8, .tangential_penalty = 1};
  const double exact = 2 * std::numbers::pi * std::sqrt(4 - 0.64);
  const auto error = [&](int samples, SlipReturn rule) {
    return std::abs(run(coefficients, law, samples, rule).slip_load - exact) / exact;
  };
  // On the circle both are symmetric: second order for the path; the second-order return has a smaller constant.
  EXPECT_NEAR(std::log2(error(256, SlipReturn::second_order) / error(512, SlipReturn::second_order)), 2, 0.05);
  EXPECT_LT(error(512, SlipReturn::second_order), 1e-4);
  EXPECT_LT(error(512, SlipReturn::first_order), 2e-2);
}

// A path without symmetry and a changing normal force: against the march with 2^16 samples. Backward Euler is first
// order (factor 16 from 128 to 2048 samples), the rotating return second (factor 256).
TEST(March, ConvergesToFineTimeIntegration) {
  Eigen::MatrixXd coefficients(3, 5);
  coefficients << 2, 0.4, 0.3, 0.1, -0.2, 0, 3, 0.5, 0.4, 0.3, 0, -0.4, 2.5, 0.6, -0.3;
  const NodeLaw law{.friction = 0.5, .tangential_penalty = 1};
  const double fine = run(coefficients, law, 1 << 16, SlipReturn::second_order).slip_load;
  const auto error = [&](int samples, SlipReturn rule) {
    return std::abs(run(coefficients, law, samples, rule).slip_load - fine) / fine;
  };
  RecordProperty("first_128", std::to_string(error(128, SlipReturn::first_order)));
  EXPECT_LT(error(2048, SlipReturn::first_order), error(128, SlipReturn::first_order) / 8);
  EXPECT_LT(error(2048, SlipReturn::second_order), error(128, SlipReturn::second_order) / 100);
  EXPECT_LT(error(2048, SlipReturn::second_order), 2e-6);
  EXPECT_LT(error(2048, SlipReturn::second_order), error(2048, SlipReturn::first_order));
}

// A node that lifts off and sticks when it touches down: where inside a sample contact begins decides the order, for
// the slip under load and for the tangential force. (Where it slips at once, force and load begin at zero and both
// rules are second order.)
TEST(March, LiftsOffToSecondOrder) {
  Eigen::MatrixXd plane(2, 5), space(3, 5);
  plane << 0.5, 1, 0.3, 0.2, -0.1, 0.2, 1.5, 0.8, 0.3, 0.4;
  space << 0.5, 1, 0.3, 0.2, -0.1, 0.2, 1.5, 0.8, 0.3, 0.4, -0.1, 0.4, -1.2, 0.2, 0.5;
  for (const Eigen::MatrixXd& coefficients : {plane, space}) {
    const NodeLaw law{.friction = 2.5, .tangential_penalty = 1};
    const auto describe = [&](int samples, SlipReturn rule) {
      const MarchResult result = run(coefficients, law, samples, rule);
      // Mean and first harmonic of lambda_T, and the load on slip.
      const FourierBasis basis(1, samples);
      Eigen::VectorXd all(4);
      all << result.slip_load, basis.analyse(result.force.col(1)).transpose();
      return all;
    };
    const Eigen::VectorXd fine = describe(1 << 16, SlipReturn::second_order);
    const auto error = [&](int samples, SlipReturn rule) -> Eigen::ArrayXd {
      return (describe(samples, rule) - fine).array().abs() / (1 + fine.array().abs());
    };
    // Where a touch lies between two samples makes the error of one N erratic: the largest of a few.
    const auto worst = [&](int samples, SlipReturn rule) {
      double largest = 0;
      for (const int extra : {0, 1, 2, 3, 5, 7}) largest = std::max(largest, error(samples + extra, rule).maxCoeff());
      return largest;
    };
    // 16 times the samples: first order gains 16, second 256.
    EXPECT_GT(worst(128, SlipReturn::second_order) / worst(2048, SlipReturn::second_order), 100);
    EXPECT_LT(worst(128, SlipReturn::first_order) / worst(2048, SlipReturn::first_order), 40);
    EXPECT_LT(worst(128, SlipReturn::second_order), worst(128, SlipReturn::first_order) / 4);
    EXPECT_LT(worst(2048, SlipReturn::second_order), 1e-5);
  }
}

}  // namespace
}  // namespace dovetail::contact
