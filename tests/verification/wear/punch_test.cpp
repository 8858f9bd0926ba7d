#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "scenes.hpp"
#include "wear/asymptote.hpp"
#include "wear/history.hpp"

// Plane partial slip under constant P and +-Q: half-width of contact a = 1, of the stick zone c = sqrt(1 - Q/(mu P)).

namespace dovetail::wear {
namespace {

using Model = std::shared_ptr<const response::CondensedModel>;

/// Closed forms for a = R = E* = 1 in the units of scenes::Punch.
struct Limit {
  double c, b;
  explicit Limit(const scenes::Punch& data)
      : c(std::sqrt(1.0 - data.tangential_load / (data.friction * data.normal_load))) {
    double low = 1.0;
    double high = 2.0;
    for (int i = 0; i < 80; ++i) (height(0.5 * (low + high)) > 0.0 ? low : high) = 0.5 * (low + high);
    b = low;
  }
  [[nodiscard]] double height(double x) const { return 0.5 * (std::acosh(x / c) - x * std::sqrt(x * x - c * c)); }
  [[nodiscard]] double depth(double x) const {
    const double at = std::abs(x);
    return at <= c || at >= b ? 0.0 : height(at);
  }
  [[nodiscard]] double volume() const {
    const double root = std::sqrt(b * b - c * c);
    return b * std::acosh(b / c) - root - root * root * root / 3.0;
  }
};

constexpr AsymptoteOptions kOptions{.rate_threshold = 0.0};

TEST(Punch, SticksInTheMiddle) {
  const scenes::Punch data{.nodes = 121};
  const auto model = std::make_shared<const response::CondensedModel>(scenes::punch(data));
  const response::SteadyState state = response::steady_state(model, 1.0, {}, {.harmonics = 3, .samples = 128});
  ASSERT_EQ(state.status, Status::converged);
  const double step = 2.0 * data.half_length / (data.nodes - 1);
  double contact = 0.0;
  double stick = 0.0;
  for (const response::NodeSummary& node : state.nodes) {
    if (node.carries_load) contact += 0.5 * step;
    if (node.stuck) stick += 0.5 * step;
  }
  // A zone is counted in whole nodes at both ends: one spacing; the truncated harmonics blur its edge by as much.
  EXPECT_NEAR(contact, 1.0, step);
  EXPECT_NEAR(stick, Limit(data).c, 2.0 * step);
}

TEST(Punch, DissipatesTheEnergyOfPartialSlip) {
  const scenes::Punch data{.nodes = 81};
  const auto model = std::make_shared<const response::CondensedModel>(scenes::punch(data));
  const response::SteadyState state = response::steady_state(model, 1.0, {}, {.harmonics = 9, .samples = 256});
  ASSERT_EQ(state.status, Status::converged);
  const double limit = data.friction * data.normal_load;
  const double s = data.tangential_load / limit;
  const double energy =
      4.0 * limit * limit / (std::numbers::pi * data.modulus) * ((1.0 - s) * std::log(1.0 - s) + s - 0.5 * s * s);
  RecordProperty("relative_error", std::to_string(state.friction_energy / energy - 1.0));
  EXPECT_NEAR(state.friction_energy, energy, 0.03 * energy);
}

TEST(Punch, WearsToTheClosedProfile) {
  double previous = 0.0;
  for (int nodes : {41, 81, 161}) {
    const scenes::Punch data{.nodes = nodes};
    const reduction::ReducedModel reduced = scenes::punch(data);
    const auto model = std::make_shared<const response::CondensedModel>(reduced);
    const Limit limit(data);
    const Asymptote worn = asymptote(model, 1.0, {}, {.harmonics = 1, .samples = 64}, kOptions);
    ASSERT_EQ(worn.verdict, Verdict::asymptote) << to_string(worn.status);
    double shape = 0.0;
    for (Eigen::Index i = 0; i < nodes; ++i)
      shape += reduced.contact.area[i] * std::abs(worn.depth[i] - limit.depth(reduced.contact.position(i, 0)));
    const double nodal = worn.worn_volume / limit.volume() - 1.0;
    const double interpolated = worn.interpolated_volume / limit.volume() - 1.0;
    const std::string name = "nodes_" + std::to_string(nodes);
    RecordProperty(name + "_volume", std::to_string(nodal));
    RecordProperty(name + "_interpolated", std::to_string(interpolated));
    RecordProperty(name + "_shape", std::to_string(shape / limit.volume()));
    RecordProperty(name + "_jacobians", worn.jacobians);
    RecordProperty(name + "_certificate", std::to_string(worn.certificate));
    previous = shape / limit.volume();
  }
  EXPECT_LT(previous, 0.1);
}

TEST(Punch, HistoryEndsWhereTheAsymptoteIs) {
  const scenes::Punch data{.nodes = 41};
  const auto model = std::make_shared<const response::CondensedModel>(scenes::punch(data));
  const response::SteadyOptions steady{.harmonics = 1, .samples = 64};
  const Asymptote worn = asymptote(model, 1.0, {}, steady, kOptions);
  ASSERT_EQ(worn.verdict, Verdict::asymptote);
  double error = 0.0;
  for (double fraction : {0.1, 0.02}) {
    const History run = history(
        model, 1.0, {}, steady,
        {.increment = fraction * worn.largest_depth, .steps = 2000, .rate_fraction = 1e-4, .rate_threshold = 0.0});
    ASSERT_EQ(run.end, HistoryEnd::worn_out) << to_string(run.end);
    const Eigen::VectorXd depth = run.depth.bottomRows(1).transpose();
    error = (depth - worn.depth).cwiseAbs().maxCoeff() / worn.largest_depth;
    RecordProperty("error_" + std::to_string(fraction), std::to_string(error));
    RecordProperty("jacobians_" + std::to_string(fraction), run.jacobians);
  }
  EXPECT_LT(error, 0.04);
}

}  // namespace
}  // namespace dovetail::wear
