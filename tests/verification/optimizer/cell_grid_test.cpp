// Contact cells across a flank: where they end depends on the edges of worn zones continuously.
#include "optimizer/candidate/cell_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace dovetail::optimizer {
namespace {

/// A flank of twelve mesh edges, each 1.2 times as long as the one before: corners and the nodes between them.
fem::TraceLines graded() {
  fem::TraceLines lines{.across = {0}, .along = {0, 1}};
  double length = 1;
  for (int edge = 0; edge < 12; ++edge, length *= 1.2)
    for (int half = 0; half < 2; ++half) lines.across.push_back(lines.across.back() + length / 2);
  for (double& place : lines.across) place /= lines.across.back();
  return lines;
}

TEST(CellGrid, EdgeLengthsAreThoseOfTheMeshAndDoNotJump) {
  const fem::TraceLines lines = graded();
  const EdgeLengths lengths(lines);
  for (std::size_t i = 2; i < lines.across.size(); i += 2)
    EXPECT_NEAR(lengths.at(lines.across[i - 1]), lines.across[i] - lines.across[i - 2], 1e-12);
  constexpr int kPlaces = 10000;
  for (int i = 0; i < kPlaces; ++i) {
    const double place = static_cast<double>(i) / kPlaces, step = 1.0 / kPlaces;
    // From edge to edge lengths grow by a fifth: with a slope below that.
    EXPECT_NEAR(lengths.at(place + step), lengths.at(place), 0.2 * step) << place;
  }
}

TEST(CellGrid, CellsEndOnTheEdgesOfWornZonesAndMoveWithThem) {
  const EdgeLengths lengths(graded());
  std::vector<double> before;
  constexpr double kStep = 1e-4;
  int compared = 0;
  for (double edge = 0.2; edge < 0.8; edge += kStep) {
    std::vector<int> counts;
    const std::vector<double> ends = cell_ends(lengths, {edge}, {}, counts);
    EXPECT_TRUE(std::ranges::is_sorted(ends));
    EXPECT_EQ(std::ranges::count(ends, edge), 1);
    if (before.size() == ends.size()) {
      // Where the number of cells stays, so do they but for little more than the edge itself.
      for (std::size_t k = 0; k < ends.size(); ++k) EXPECT_NEAR(ends[k], before[k], 2 * kStep) << edge << " " << k;
      ++compared;
    }
    before = ends;
  }
  EXPECT_GT(compared, 5000);
}

}  // namespace
}  // namespace dovetail::optimizer
