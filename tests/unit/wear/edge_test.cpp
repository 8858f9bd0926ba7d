#include "wear/edge.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace dovetail::wear {
namespace {

using Eigen::VectorXd;

reduction::ContactNodes line(int count) {
  reduction::ContactNodes contact;
  contact.normal = Eigen::VectorXi::Zero(count);
  contact.tangential = Eigen::MatrixXi::Zero(count, 1);
  return contact;
}

TEST(FlankNeighbours, FollowPlaceNotIndex) {
  reduction::ContactNodes contact = line(4);
  contact.position = Eigen::MatrixX3d::Zero(4, 3);
  contact.position.col(1) << 3.0, 1.0, 2.0, 0.0;
  const Eigen::MatrixX2i found = flank_neighbours(contact);
  // Along y: 3, 1, 2, 0; which end comes first is free.
  const auto pair = [&found](int node) { return std::minmax(found(node, 0), found(node, 1)); };
  EXPECT_EQ(pair(1), (std::pair<const int&, const int&>(2, 3)));
  EXPECT_EQ(pair(2), (std::pair<const int&, const int&>(0, 1)));
  EXPECT_EQ(pair(0), (std::pair<const int&, const int&>(-1, 2)));
  EXPECT_EQ(pair(3), (std::pair<const int&, const int&>(-1, 1)));
}

TEST(FlankNeighbours, DoNotCrossFlanks) {
  reduction::ContactNodes contact = line(4);
  contact.group.resize(4);
  contact.group << 0, 0, 1, 1;
  const Eigen::MatrixX2i found = flank_neighbours(contact);
  EXPECT_EQ(found(1, 1), -1);
  EXPECT_EQ(found(2, 0), -1);
  EXPECT_EQ(found(0, 1), 1);
  EXPECT_EQ(found(3, 0), 2);
}

TEST(FindEdges, TakesReleasedNodesNextToStuckOnes) {
  const reduction::ContactNodes contact = line(7);
  const std::vector<bool> released{true, true, false, false, true, false, true};
  // Node 5 carries nothing: it is no edge. Node 4 leans on 3.
  const std::vector<bool> loaded{false, false, true, true, false, false, false};
  VectorXd margin(7);
  margin << 9, 9, 0.3, 0.2, 9, 9, 9;
  const std::vector<Edge> edges = find_edges(contact, released, loaded, margin);
  ASSERT_EQ(edges.size(), 2u);
  EXPECT_EQ(edges[0].worn, 1);
  EXPECT_EQ(edges[0].stuck, 2);
  EXPECT_DOUBLE_EQ(edges[0].margin, 0.3);
  EXPECT_EQ(edges[1].worn, 4);
  EXPECT_EQ(edges[1].stuck, 3);
}

TEST(Edge, MovesFromTheWornToTheStuckNode) {
  Edge edge{.excess = 0.0, .margin = 0.5};
  edge.place();
  EXPECT_EQ(edge.theta, 0.0);
  edge = {.excess = 0.5, .margin = 0.0};
  edge.place();
  EXPECT_EQ(edge.theta, 1.0);
  edge = {.excess = 0.1, .margin = 0.3};
  edge.place();
  EXPECT_DOUBLE_EQ(edge.theta, 0.25);
  edge = {.excess = 0.1, .margin = std::numeric_limits<double>::infinity()};
  edge.place();
  EXPECT_EQ(edge.theta, 0.0);
}

TEST(InterpolateEdges, IsExactWhereDepthsAreLinearInTheSet) {
  // Depths 1, 2, 3 for e held, as found, k released: the edge at theta is theta - 1/2 nodes beyond "as found".
  for (double theta : {0.0, 0.3, 1.0}) {
    std::vector<Edge> edges(1);
    edges[0].theta = theta;
    const std::vector<EdgeStates> states{{.held = VectorXd::Constant(1, 1.0), .next = VectorXd::Constant(1, 3.0)}};
    EXPECT_NEAR(interpolate_edges(edges, VectorXd::Constant(1, 2.0), states)[0], 1.5 + theta, 1e-15);
  }
}

TEST(InterpolateEdges, ContinuesInValueAndSlopeWhenANodeJoins) {
  // Sets j, j+1, ... of one edge have depths j^2; set j at theta = 1 is set j+1 at theta = 0.
  const auto depth = [](double set, double theta) {
    std::vector<Edge> edges(1);
    edges[0].theta = theta;
    const std::vector<EdgeStates> states{{.held = VectorXd::Constant(1, (set - 1.0) * (set - 1.0)),
                                          .next = VectorXd::Constant(1, (set + 1.0) * (set + 1.0))}};
    return interpolate_edges(edges, VectorXd::Constant(1, set * set), states)[0];
  };
  EXPECT_NEAR(depth(4.0, 1.0), depth(5.0, 0.0), 1e-13);
  const double step = 1e-6;
  const double before = (depth(4.0, 1.0) - depth(4.0, 1.0 - step)) / step;
  const double after = (depth(5.0, step) - depth(5.0, 0.0)) / step;
  EXPECT_NEAR(before, after, 1e-5);  // second derivative 2 times the step, and rounding 1e-9
}

TEST(InterpolateEdges, NeverGivesNegativeDepths) {
  std::vector<Edge> edges(2);
  edges[0].theta = edges[1].theta = 0.0;
  const std::vector<EdgeStates> states(2, {.held = VectorXd::Constant(1, -3.0), .next = VectorXd::Zero(1)});
  EXPECT_EQ(interpolate_edges(edges, VectorXd::Ones(1), states)[0], 0.0);
}

}  // namespace
}  // namespace dovetail::wear
