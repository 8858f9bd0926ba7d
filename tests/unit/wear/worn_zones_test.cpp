#include "wear/asymptote/worn_zones.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace dovetail::wear {
namespace {

/// Ten nodes of one square millimetre.
std::vector<NodeLine> ten_nodes() {
  NodeLine line{.nodes = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9}, .ends = {0}};
  for (int k = 1; k <= 10; ++k) line.ends.push_back(k / 10.0);
  return {line};
}

const Eigen::VectorXd kArea = Eigen::VectorXd::Constant(10, 1e-6);

/// Depths of a zone of `width` cells from the beginning of the flank, W ~ (w - x)^(3/2).
Eigen::VectorXd zone(double width, double deepest = 1e-6) {
  Eigen::VectorXd depth = Eigen::VectorXd::Zero(10);
  for (int k = 0; k < 10; ++k) depth(k) = deepest * std::pow(std::max(0.0, (width - k - 0.5) / width), 1.5);
  return depth;
}

std::vector<bool> worn(int cells) {
  std::vector<bool> result(10, false);
  std::fill_n(result.begin(), cells, true);
  return result;
}

TEST(WornZones, ChangeByWhatTheirOpenEndsAllow) {
  const Eigen::VectorXd depth = zone(8);
  // Twice the part, twice the change; the end of the flank is no end.
  const WornChange quarter = ends_moved_by(0.25, ten_nodes(), kArea, worn(8), depth);
  EXPECT_NEAR(quarter.volume, 2.5 * 0.25 / 8 * 1e-6 * depth.sum(), 1e-18);
  EXPECT_NEAR(quarter.depth, 1.5 * 0.25 / 8 * depth(0), 1e-12);
  EXPECT_NEAR(ends_moved_by(0.5, ten_nodes(), kArea, worn(8), depth).volume, 2 * quarter.volume, 1e-18);
  EXPECT_EQ(ends_moved_by(1, ten_nodes(), kArea, worn(10), depth).volume, 0);
  // No more than there is.
  EXPECT_NEAR(ends_moved_by(1, ten_nodes(), kArea, worn(1), zone(1)).volume, 1e-6 * zone(1).sum(), 1e-18);
}

TEST(WornZones, ANodeApartDifferByWhatANodeExplains) {
  const std::vector<NodeLine> lines = ten_nodes();
  EXPECT_TRUE(a_node_apart(lines, kArea, zone(9.5), zone(8.9)));
  EXPECT_TRUE(a_node_apart(lines, kArea, zone(8.9), zone(9.5)));
  // Alike, two nodes, or a node in the middle.
  EXPECT_FALSE(a_node_apart(lines, kArea, zone(9), zone(9)));
  EXPECT_FALSE(a_node_apart(lines, kArea, zone(9.5), zone(7.6)));
  Eigen::VectorXd with_a_hole = zone(9);
  with_a_hole(4) = 0;
  EXPECT_FALSE(a_node_apart(lines, kArea, zone(9), with_a_hole));
  // The same nodes, but far more wear than a node at the end explains; and zones so narrow that a node is most of them.
  EXPECT_FALSE(a_node_apart(lines, kArea, zone(9.5), zone(8.9, 0.5e-6)));
  EXPECT_FALSE(a_node_apart(lines, kArea, zone(3), zone(2.4)));
}

TEST(WornZones, WithoutNeighboursAreNeverANodeApart) {
  EXPECT_FALSE(a_node_apart({}, kArea, zone(9.5), zone(8.9)));
  EXPECT_TRUE(far_apart(kArea, zone(9), zone(7)));
  EXPECT_FALSE(far_apart(kArea, zone(9), zone(8.5)));
}

TEST(WornZones, EnergyIsOpenWhereASlippingZoneIsANodeOrTwoWide) {
  const std::vector<NodeLine> lines = ten_nodes();
  const std::vector<bool> loaded(10, true);
  // Slip is largest at the inner end.
  const auto zone_of = [](int nodes) {
    Eigen::VectorXd energy = Eigen::VectorXd::Zero(10);
    for (int k = 0; k < nodes; ++k) energy(k) = 1e-6 * (k + 1) * 2 / (nodes * (nodes + 1.0));
    return energy;
  };
  EXPECT_DOUBLE_EQ(energy_left_open(lines, kArea, zone_of(1), loaded), 0.4e-6);
  EXPECT_DOUBLE_EQ(energy_left_open(lines, kArea, zone_of(2), loaded), 0.4e-6 * std::pow(2.0 / 3, 3));
  EXPECT_LT(energy_left_open(lines, kArea, zone_of(6), loaded), 0.01e-6);
  // The other way round, and with creep where it sticks.
  Eigen::VectorXd turned = zone_of(2).reverse();
  turned(7) = 1e-10;
  EXPECT_NEAR(energy_left_open(lines, kArea, turned, loaded), 0.4e-6 * std::pow(2.0 / 3, 3), 1e-12);
  // A single node between two that stick: on both sides.
  Eigen::VectorXd alone = Eigen::VectorXd::Zero(10);
  alone(4) = 1e-6;
  EXPECT_DOUBLE_EQ(energy_left_open(lines, kArea, alone, loaded), 0.8e-6);
  // No node beyond, or none that bears: there it ends on other nodes, too.
  EXPECT_EQ(energy_left_open(lines, kArea, zone_of(10), loaded), 0);
  std::vector<bool> open_beyond = loaded;
  open_beyond[2] = false;
  EXPECT_EQ(energy_left_open(lines, kArea, zone_of(2), open_beyond), 0);
  EXPECT_EQ(energy_left_open(lines, kArea, Eigen::VectorXd::Zero(10), loaded), 0);
}

}  // namespace
}  // namespace dovetail::wear
