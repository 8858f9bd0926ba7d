#include "contact/contact_law.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include "contact/march.hpp"

namespace dovetail::contact {
namespace {

// Friction that a shear strength bounds: no law of the library, but a march knows of a law what its limit tells.
const ContactLaw kBounded{.name = "bounded", .limit = [](const NodeLaw& node, double normal) {
                            constexpr double kStrength = 1.5;
                            const double part = std::tanh(node.friction * normal / kStrength);
                            return FrictionLimit{.force = kStrength * part,
                                                 .by_normal = node.friction * (1 - part * part)};
                          }};

std::vector<const ContactLaw*> laws() {
  std::vector<const ContactLaw*> all(contact_laws().begin(), contact_laws().end());
  all.push_back(&kBounded);
  return all;
}

// What every contact law promises, by itself and in a march; a new one is in contact_laws() and passes.
class ContactLawContract : public testing::TestWithParam<std::tuple<const ContactLaw*, Eigen::Index, SlipReturn>> {
 protected:
  static constexpr int kSamples = 64;

  MarchResult run(const Eigen::MatrixXd& coefficients, bool derivative = false) const {
    const Eigen::MatrixXd samples = basis_.synthesise(coefficients);
    MarchResult result;
    march(samples, node_, {.slip_return = rule_, .tolerance = 1e-14}, result);
    if (derivative) differentiate(samples, node_, basis_, rule_, result);
    return result;
  }

  // lambda_u of a node that lifts off, sticks and slips.
  Eigen::MatrixXd random_prediction() {
    std::normal_distribution<double> normal;
    Eigen::MatrixXd at = Eigen::MatrixXd::NullaryExpr(d_, basis_.coefficients(), [&] { return normal(generator_); });
    at(0, 0) = 1.5;
    return at;
  }

  const ContactLaw& law_ = *std::get<0>(GetParam());
  const Eigen::Index d_ = std::get<1>(GetParam());
  const SlipReturn rule_ = std::get<2>(GetParam());
  const numerics::FourierBasis basis_{3, kSamples};
  NodeLaw node_{.law = &law_, .friction = 0.6, .tangential_penalty = 1.7};
  std::mt19937 generator_{7};
};

TEST_P(ContactLawContract, LimitsMoreUnderMoreLoadAndHasItsDerivative) {
  EXPECT_EQ(node_.limit(0).force, 0);
  EXPECT_TRUE(node_.rubs());
  for (const double normal : {1e-3, 0.5, 2.0, 10.0}) {
    constexpr double kStep = 1e-5;
    const FrictionLimit at = node_.limit(normal);
    EXPECT_GT(at.force, 0);
    EXPECT_GE(at.by_normal, 0);
    EXPECT_NEAR(at.by_normal, (node_.limit(normal + kStep).force - node_.limit(normal - kStep).force) / (2 * kStep),
                1e-9);
  }
  node_.friction = 0;
  EXPECT_EQ(node_.limit(1).force, 0);
  EXPECT_FALSE(node_.rubs());
}

TEST_P(ContactLawContract, HoldsAtEverySampleOfAMarch) {
  int slipping = 0, stuck = 0, separated = 0;
  for (int i = 0; i < 8; ++i) {
    const MarchResult result = run(random_prediction());
    ASSERT_EQ(result.status, Status::converged);
    for (Eigen::Index n = 0; n < kSamples; ++n) {
      const double normal = result.force(n, 0), tangential = result.force.row(n).tail(d_ - 1).norm();
      const double limit = node_.limit(normal).force;
      switch (result.state[static_cast<std::size_t>(n)]) {
        case SampleState::separated:
          ++separated;
          EXPECT_EQ(result.force.row(n).norm(), 0);
          break;
        case SampleState::stuck:
          ++stuck;
          EXPECT_LE(tangential, limit * (1 + 1e-12));
          break;
        case SampleState::slipping:
          ++slipping;
          EXPECT_NEAR(tangential, limit, 1e-12 * limit);
          // Slip goes the way of the force; over one sample the second-order rule turns both.
          EXPECT_GT(result.force.row(n).tail(d_ - 1).dot(result.slip_step.row(n)), -1e-12);
          break;
      }
    }
  }
  EXPECT_GT(slipping, 20);
  EXPECT_GT(stuck, 20);
  EXPECT_GT(separated, 20);
}

TEST_P(ContactLawContract, DissipatesTheLimitForceOnTheSlip) {
  for (int i = 0; i < 8; ++i) {
    const MarchResult result = run(random_prediction());
    double energy = 0;
    for (Eigen::Index n = 0; n < kSamples; ++n) {
      const double now = result.force(n, 0), before = result.force((n + kSamples - 1) % kSamples, 0);
      if (now + before > 0)
        energy += (node_.limit(now).force + node_.limit(before).force) / 2 * result.slip_step.row(n).norm() /
                  node_.tangential_penalty;
    }
    EXPECT_GT(energy, 0);
    EXPECT_NEAR(result.dissipation, energy, 1e-12 * energy);
  }
}

TEST_P(ContactLawContract, HasTheDerivativeOfItsMarch) {
  int compared = 0;
  for (int i = 0; i < 16; ++i) {
    const Eigen::MatrixXd at = random_prediction();
    const Eigen::MatrixXd way = random_prediction();
    const MarchResult base = run(at, true);
    // Central differences: h^2 from the third derivative, 1e-16 / h from rounding.
    constexpr double kStep = 1e-6;
    const MarchResult plus = run(at + kStep * way), minus = run(at - kStep * way);
    if (plus.state != base.state || minus.state != base.state || plus.periods != base.periods ||
        minus.periods != base.periods)
      continue;  // a kink lies between
    ++compared;
    const Eigen::MatrixXd change = basis_.analyse((plus.force - minus.force) / (2 * kStep));
    const Eigen::VectorXd exact = base.force_derivative * way.reshaped();
    EXPECT_LT((exact - Eigen::VectorXd(change.reshaped())).norm(), 1e-7 * (1 + exact.norm()));
    EXPECT_NEAR(base.slip_load_derivative.dot(way.reshaped()), (plus.slip_load - minus.slip_load) / (2 * kStep),
                1e-7 * (1 + base.slip_load_derivative.norm()));
    EXPECT_NEAR(base.dissipation_derivative.dot(way.reshaped()), (plus.dissipation - minus.dissipation) / (2 * kStep),
                1e-7 * (1 + base.dissipation_derivative.norm()));
  }
  EXPECT_GE(compared, 8);
}

INSTANTIATE_TEST_SUITE_P(All, ContactLawContract,
                         testing::Combine(testing::ValuesIn(laws()), testing::Values(2, 3),
                                          testing::Values(SlipReturn::first_order, SlipReturn::second_order)),
                         [](const auto& of) {
                           return std::string(std::get<0>(of.param)->name) +
                                  (std::get<1>(of.param) == 2 ? "_plane" : "_space") +
                                  (std::get<2>(of.param) == SlipReturn::first_order ? "_first" : "_second");
                         });

}  // namespace
}  // namespace dovetail::contact
