#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "paths/steady_state.hpp"
#include "scenes.hpp"
#include "wear/asymptote/asymptote.hpp"
#include "wear/history/history.hpp"

// Plane partial slip under constant P and +-Q: half-width of contact a = 1, of the stick zone c = sqrt(1 - Q/(mu P)).

namespace dovetail::wear {
namespace {

using Model = std::shared_ptr<const dynamics::CondensedModel>;

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

// The direct answer: histories of the discrete punch wear one node more where the last one that sticks has little to
// spare, which the continuum, whose c stays, does not.
const AsymptoteOptions kDirect{.rate_threshold = 0.0, .arbitration = Arbitration::unsettled};

TEST(Punch, SticksInTheMiddle) {
  const scenes::Punch data{.nodes = 121};
  const auto model = std::make_shared<const dynamics::CondensedModel>(scenes::punch(data));
  const steady::State state = paths::steady_state({model, {}, {.harmonics = 3, .samples = 128}}, 1.0);
  ASSERT_EQ(state.status, Status::converged);
  const double step = 2.0 * data.half_length / (data.nodes - 1);
  double contact = 0.0;
  double stick = 0.0;
  for (const steady::NodeSummary& node : state.nodes) {
    if (node.carries_load) contact += 0.5 * step;
    if (node.stuck) stick += 0.5 * step;
  }
  // A zone is counted in whole nodes at both ends: one spacing; the truncated harmonics blur its edge by as much.
  EXPECT_NEAR(contact, 1.0, step);
  EXPECT_NEAR(stick, Limit(data).c, 2.0 * step);
}

TEST(Punch, DissipatesTheEnergyOfPartialSlip) {
  const scenes::Punch data{.nodes = 81};
  const auto model = std::make_shared<const dynamics::CondensedModel>(scenes::punch(data));
  const steady::State state = paths::steady_state({model, {}, {.harmonics = 9, .samples = 256}}, 1.0);
  ASSERT_EQ(state.status, Status::converged);
  const double limit = data.friction * data.normal_load;
  const double s = data.tangential_load / limit;
  const double energy =
      4.0 * limit * limit / (std::numbers::pi * data.modulus) * ((1.0 - s) * std::log(1.0 - s) + s - 0.5 * s * s);
  RecordProperty("relative_error", std::to_string(state.friction_energy / energy - 1.0));
  EXPECT_NEAR(state.friction_energy, energy, 0.03 * energy);
}

TEST(Punch, WearsToTheClosedProfile) {
  for (int nodes : {41, 81, 121}) {
    const scenes::Punch data{.nodes = nodes};
    const reduction::ReducedModel reduced = scenes::punch(data);
    const auto model = std::make_shared<const dynamics::CondensedModel>(reduced);
    const Limit limit(data);
    const Asymptote worn = asymptote({model, {}, {.harmonics = 3, .samples = 64}}, 1.0, kDirect);
    ASSERT_EQ(worn.verdict, Verdict::asymptote) << to_string(worn.status);
    EXPECT_LT(worn.certificate, 1e-9);
    double shape = 0.0;
    for (Eigen::Index i = 0; i < nodes; ++i)
      shape += reduced.contact.area[i] * std::abs(worn.depth[i] - limit.depth(reduced.contact.position(i, 0)));
    shape /= limit.volume();
    const double nodal = worn.worn_volume / limit.volume() - 1.0;
    const std::string name = "nodes_" + std::to_string(nodes);
    RecordProperty(name + "_volume", std::to_string(nodal));
    RecordProperty(name + "_shape", std::to_string(shape));
    RecordProperty(name + "_jacobians", worn.jacobians);
    // With r^2 = b^2 - c^2, dV/dc = -r (1 - c^2) / c, here -8.9 V: a nodal answer, whose edge lies up to half a
    // spacing off, errs by up to 4.5 spacings. Profiles are compared in the mean, because the slope of the limit at c
    // is vertical.
    const double spacing = 2.0 * data.half_length / (nodes - 1);
    EXPECT_LT(std::abs(nodal), 4.5 * spacing) << nodes;
    EXPECT_LT(shape, 4.5 * spacing) << nodes;
  }
}

// The stick zone of the unworn punch ends at c; release finds whole nodes, the reserves of friction the place between.
TEST(Punch, EdgesLieBetweenTheNodesWhereStickEnds) {
  double worst = 0.0;
  for (int i = 0; i < 12; ++i) {
    const scenes::Punch data{.nodes = 61, .tangential_load = 0.17 + 0.004 * i};
    const reduction::ReducedModel reduced = scenes::punch(data);
    const auto model = std::make_shared<const dynamics::CondensedModel>(reduced);
    const Asymptote worn = asymptote({model, {}, {.harmonics = 9, .samples = 256}}, 1.0, kDirect);
    ASSERT_EQ(worn.verdict, Verdict::asymptote);
    std::vector<NodeLine> line(1);
    for (int node = 0; node < data.nodes; ++node) line[0].nodes.push_back(node);
    const std::vector<ZoneEdge> edges = zone_edges(worn.trail, line, reduced.contact.area);
    ASSERT_EQ(edges.size(), 2u);
    const double spacing = 2.0 * data.half_length / (data.nodes - 1);
    for (const ZoneEdge& edge : edges) {
      const double from = reduced.contact.position(edge.worn, 0), to = reduced.contact.position(edge.bearing, 0);
      const double place = std::abs(from + edge.fraction * (to - from));
      worst = std::max(worst, std::abs(place - Limit(data).c) / spacing);
    }
  }
  RecordProperty("worst", std::to_string(worst));
  // Whole nodes are up to a spacing off.
  EXPECT_LT(worst, 0.3);
}

TEST(Punch, HistoryEndsWhereTheAsymptoteIs) {
  const scenes::Punch data{.nodes = 41};
  const auto model = std::make_shared<const dynamics::CondensedModel>(scenes::punch(data));
  const steady::Options steady{.harmonics = 3, .samples = 64};
  const Asymptote worn = asymptote({model, {}, steady}, 1.0, kDirect);
  ASSERT_EQ(worn.verdict, Verdict::asymptote);
  double error = 0.0;
  for (double fraction : {0.1, 0.02}) {
    const History run = history(
        {model, {}, steady}, {.omega = 1.0},
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
