#include "paths/resonance.hpp"

#include <gtest/gtest.h>

#include "paths/amplitude.hpp"
#include "paths/continuation.hpp"
#include "paths/frequency_response.hpp"
#include "paths/peak_sweep.hpp"
#include "paths/steady_state.hpp"
#include "tests/verification/steady/gap_oscillator.hpp"

namespace dovetail::verification {
namespace {

TEST(Resonance, IsTheClosedFormOfALinearOscillator) {
  // Amplitude peaks at w_n sqrt(1 - 2 zeta^2) with F / (2 k zeta sqrt(1 - zeta^2)); the contact is stuck beside it.
  const double zeta = 0.001, natural = 200;
  reduction::ReducedModel model = empty_model(3, 1, 1);
  model.mass(0, 0) = 2;
  model.stiffness.diagonal() << 2 * natural * natural, 1, 1;
  model.damping(0, 0) = 2 * 2 * natural * zeta;
  model.contact.normal << 1;
  model.contact.tangential << 2;
  model.contact.friction << 0.5;
  model.static_force(1) = 1;
  model.cosine_force(0, 0) = 1;
  model.output_vectors = Eigen::MatrixXd::Identity(1, 3);
  model.output_names = {"x"};
  for (const double start : {200.0, 190.0, 215.0}) {
    const paths::Resonance peak = paths::resonance({condensed(model), {}, {}}, start);
    ASSERT_EQ(peak.status, Status::converged) << start;
    EXPECT_NEAR(peak.omega / (natural * std::sqrt(1 - 2 * zeta * zeta)), 1, 1e-7);
    EXPECT_NEAR(peak.amplitude * 2 * 2 * natural * natural * zeta * std::sqrt(1 - zeta * zeta), 1, 1e-9);
    EXPECT_LE(peak.solves, 10);
  }
}

TEST(Resonance, MatchesADenseSweepWithFriction) {
  reduction::ReducedModel model = rod(10);
  model.cosine_force *= 0.05 / 0.3;
  const auto prepared = condensed(model);
  const paths::Resonance peak = paths::resonance({prepared, {}, {}}, prepared->glued_frequencies()(0));
  ASSERT_EQ(peak.status, Status::converged);
  ASSERT_TRUE(peak.state.tangent);
  EXPECT_GT(peak.state.friction_energy, 0);
  std::vector<double> omega;
  for (int i = -20; i <= 20; ++i) omega.push_back(peak.omega * (1 + 2e-5 * i));
  const std::vector<steady::State> sweep = paths::frequency_response({prepared, {}, {}}, omega);
  for (std::size_t i = 0; i < sweep.size(); ++i) {
    ASSERT_EQ(sweep[i].status, Status::converged);
    // A maximum: nothing higher nearby, beyond rounding of a solve to 1e-9.
    EXPECT_LE(sweep[i].amplitudes(0), peak.amplitude * (1 + 1e-9));
  }
  // And beside it, on both sides, lower by more than that.
  EXPECT_LT(sweep.front().amplitudes(0), peak.amplitude * (1 - 1e-7));
  EXPECT_LT(sweep.back().amplitudes(0), peak.amplitude * (1 - 1e-7));
}

TEST(Resonance, HasAnExactSlope) {
  const auto model = condensed(rod(10));
  const steady::Options tight{.harmonics = 5, .tolerance = 1e-13};
  const double omega = 2.6, h = 1e-6;
  const paths::AmplitudeSlope at = paths::amplitude_slope(paths::steady_state({model, {}, tight}, omega), 0);
  const double difference = (paths::steady_state({model, {}, tight}, omega + h).amplitudes(0) -
                             paths::steady_state({model, {}, tight}, omega - h).amplitudes(0)) /
                            (2 * h);
  EXPECT_NEAR(at.slope, difference, 1e-6 * std::abs(difference));
}

TEST(Resonance, SaysWhenThereIsNone) {
  const paths::Resonance peak =
      paths::resonance({condensed(rod(10)), {}, {}}, 3.5, {.search_range = 0.02, .sweep_range = 0});
  EXPECT_EQ(peak.status, Status::no_bracket);
}

// The first point of the branch may not be computed at all, and then has no amplitude.
TEST(PeakSweep, SaysWhyItCannotBegin) {
  reduction::ReducedModel model = rod(10);
  model.cosine_force *= 1e300;
  const steady::Joint overflowing{condensed(model), {}, {}};
  ASSERT_EQ(paths::steady_state(overflowing, 2.6).amplitudes.size(), 0);
  const paths::Resonance none = paths::peak_sweep(overflowing, 2.4, 2.8, {});
  EXPECT_EQ(none.status, Status::not_finite);
  EXPECT_EQ(none.ends, 0);
}

TEST(Resonance, IsFoundFarBelowTheGluedFrequency) {
  // Ten times the excitation of the test above: everything slides, and the peak is a quarter below the glued frequency.
  const auto model = condensed(rod(10));
  const double glued = model->glued_frequencies()(0);
  const paths::Resonance near = paths::resonance({model, {}, {}}, glued, {.sweep_range = 0});
  EXPECT_EQ(near.status, Status::no_bracket);
  const paths::Resonance peak = paths::resonance({model, {}, {}}, glued);
  ASSERT_EQ(peak.status, Status::converged);
  EXPECT_TRUE(peak.swept);
  EXPECT_LT(peak.omega, 0.8 * glued);
  EXPECT_TRUE(peak.state.tangent);
  std::vector<double> omega;
  for (int i = 0; i < 180; ++i) omega.push_back((0.3 + 0.005 * i) * glued);
  for (const steady::State& state : paths::frequency_response({model, {}, {}}, omega)) {
    ASSERT_EQ(state.status, Status::converged);
    EXPECT_LE(state.amplitudes(0), peak.amplitude * (1 + 1e-8)) << state.omega;
  }
}

TEST(Resonance, IsFoundOnABranchThatLeansOver) {
  // From the glued frequency sqrt(2) the response is on the low branch; the maximum is on the other one, near its turn.
  const auto model = condensed(gap_oscillator(1, 0.02, 0.1));
  const steady::Options steady{.harmonics = 7, .samples = 256, .tolerance = 1e-11};
  const paths::Resonance peak = paths::resonance({model, {}, steady}, model->glued_frequencies()(0));
  ASSERT_EQ(peak.status, Status::converged);
  const branches::Branch branch = paths::continuation({model, {}, steady}, 0.8, 1.4);
  double highest = 0;
  for (const branches::BranchPoint& point : branch.points) highest = std::max(highest, point.state.amplitudes(0));
  EXPECT_GE(peak.amplitude, highest);
  EXPECT_LT(peak.amplitude, 1.02 * highest);
}

TEST(Resonance, IsClimbedWhereStepsInFrequencyFallOffTheBranch) {
  const auto model = condensed(gap_oscillator(1, 0.02, 0.1));
  const steady::Options steady{.harmonics = 7, .samples = 256, .tolerance = 1e-11};
  const branches::Branch branch = paths::continuation({model, {}, steady}, 1.4, 0.8);
  double highest = 0;
  for (const branches::BranchPoint& point : branch.points) highest = std::max(highest, point.state.amplitudes(0));
  int starts = 0;
  for (const double share : {0.5, 0.7, 0.9}) {
    for (const branches::BranchPoint& point : branch.points) {
      if (point.state.amplitudes(0) < share * highest) continue;
      const paths::Resonance peak =
          paths::resonance({model, {}, steady}, point.state.omega, {.sweep_range = 0}, point.state.displacement);
      ASSERT_EQ(peak.status, Status::converged) << share;
      // Near the fold the sampled branch is a saw whose teeth are a few thousandths high.
      EXPECT_NEAR(peak.amplitude / highest, 1, 0.01);
      EXPECT_LE(peak.jacobians, 150);
      ++starts;
      break;
    }
  }
  EXPECT_EQ(starts, 3);
}

TEST(Resonance, OfAnUndampedGluedStructureIsFoundBesideItsPole) {
  reduction::ReducedModel model = rod(3);
  model.damping.setZero();
  const auto prepared = condensed(model);
  const paths::Resonance peak = paths::resonance({prepared, {}, {}}, prepared->glued_frequencies()(0));
  ASSERT_EQ(peak.status, Status::converged);
  EXPECT_GT(peak.state.friction_energy, 0);
}

}  // namespace
}  // namespace dovetail::verification
