#include "wear/worn_zones.hpp"

#include <gtest/gtest.h>

namespace dovetail::wear {
namespace {

constexpr double kOpen = -1;  // a node without load

// Ten nodes: positive numbers slip with that overload, zero and below stick with that margin.
std::vector<NodeInPass> line(const std::vector<double>& excess, const std::vector<double>& margin) {
  std::vector<NodeInPass> nodes;
  for (std::size_t i = 0; i < excess.size(); ++i)
    nodes.push_back({.loaded = margin[i] != kOpen,
                     .slips = excess[i] > 0,
                     .excess = excess[i],
                     .margin = std::max(0.0, margin[i]),
                     .load = 1});
  return nodes;
}

TEST(WornZones, EndWhereOverloadAndMarginSay) {
  WornZones zones(6);
  zones.extend(line({3, 2, 0.3, 0, 0, 0}, {0, 0, 0, 0.1, 0.5, 1}));
  // The edge is 0.3 / (0.3 + 0.1) of the way from node 2 to 3: 0.25 of a spacing into node 3's half.
  Eigen::VectorXd expected(6);
  expected << 1, 1, 1, 0.25, 0, 0;
  EXPECT_LT((zones.share() - expected).norm(), 1e-15);
  zones.extend(line({0, 0, 0, 0, 0, 0}, {1, 1, 1, 1, 1, 1}));
  EXPECT_LT((zones.share() - expected).norm(), 1e-15);
}

TEST(WornZones, AreContinuousWhenANodeJoinsOrLeaves) {
  const auto share = [](const std::vector<double>& excess, const std::vector<double>& margin) {
    WornZones zones(6);
    zones.extend(line(excess, margin));
    return zones.share();
  };
  // Node 3 about to slip, and just slipping.
  EXPECT_LT(
      (share({2, 1, 0.4, 0, 0, 0}, {0, 0, 0, 1e-12, 0.4, 1}) - share({2, 1, 0.4, 1e-12, 0, 0}, {0, 0, 0, 0, 0.4, 1}))
          .norm(),
      1e-10);
  // A zone of one node is born with no width, and grows to both sides.
  EXPECT_LT(share({0, 0, 1e-12, 0, 0, 0}, {1, 1, 0, 1, 1, 1}).norm(), 1e-10);
  EXPECT_NEAR(share({0, 0, 0.5, 0, 0, 0}, {1, 0.5, 0, 0.5, 1, 1})[2], 1, 1e-15);
  // Two zones meet in a node that is about to slip.
  EXPECT_LT(
      (share({2, 1, 0, 1, 2, 2}, {0, 0, 1e-13, 0, 0, 0}) - share({2, 1, 1e-13, 1, 2, 2}, {0, 0, 0, 0, 0, 0})).norm(),
      1e-10);
}

TEST(WornZones, MoveOnFromWhereTheyAre) {
  const auto grown = [](double first, double second) {
    WornZones zones(8);
    zones.extend(line({3, 2, 0.3, 0, 0, 0, 0, 0}, {0, 0, 0, 0.9, 1, 1, 1, 1}));  // ends at 2.25
    zones.extend(line({0, 0, 0, first, second, 0, 0, 0}, {0, 0, 0, 0.1, 0.1, 0.3, 1, 1}));
    return zones.share().sum();
  };
  const double before = grown(0, 0);
  EXPECT_NEAR(before, 2.75, 1e-14);  // half of node 0 lies outside the line: a whole node all the same
  EXPECT_NEAR(grown(1e-13, 0), before, 1e-10);
  EXPECT_NEAR(grown(0.1, 0), before + 0.5, 1e-14);
  EXPECT_NEAR(grown(0.1, 0.1), before + 1.25, 1e-14);
}

TEST(WornZones, TakeInNodesWithoutLoadBesideThem) {
  WornZones zones(6);
  zones.extend(line({0, 0.2, 0.3, 0, 0, 0}, {kOpen, 0, 0, kOpen, kOpen, 1}));
  Eigen::VectorXd expected(6);
  expected << 1, 1, 1, 1, 0.5, 0;
  EXPECT_LT((zones.share() - expected).norm(), 1e-15);
}

}  // namespace
}  // namespace dovetail::wear
