#include <gtest/gtest.h>

#include <vector>

#include "wear/release/passes.hpp"

namespace dovetail::wear {
namespace {

struct Node {
  double rate;
  bool separates, loaded = true;
};

std::vector<bool> off(const std::vector<Node>& nodes, const std::vector<bool>& done) {
  steady::State state;
  for (const Node& node : nodes) {
    steady::NodeSummary summary;
    summary.wear_rate = node.rate;
    summary.separates = node.separates;
    summary.carries_load = node.loaded;
    state.nodes.push_back(summary);
  }
  return wear_off(state, done, 1e-6);
}

TEST(WearOff, TakesWhatSlipsUnderLoad) {
  // Above and below the threshold, in contact throughout and at times, without load, done already.
  EXPECT_EQ(off({{1.0, false}, {2e-6, false}, {5e-7, false}, {0.5, true}, {0.0, true, false}, {1.0, false}},
                {false, false, false, false, false, true}),
            (std::vector<bool>{true, true, false, true, false, false}));
}

TEST(WearOff, LetsNodesThatTouchAtTimesWaitForMuchFasterOnes) {
  EXPECT_EQ(off({{1.0, false}, {0.01, true}, {0.03, true}}, {false, false, false}),
            (std::vector<bool>{true, false, true}));
  // Their turn comes when the fast one is done.
  EXPECT_EQ(off({{1.0, false}, {0.01, true}, {0.03, true}}, {true, false, true}),
            (std::vector<bool>{false, true, false}));
}

}  // namespace
}  // namespace dovetail::wear
