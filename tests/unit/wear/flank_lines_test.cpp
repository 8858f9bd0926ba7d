#include "wear/flank_lines.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace dovetail::wear {
namespace {

reduction::ContactNodes line(int count) {
  reduction::ContactNodes contact;
  contact.normal = Eigen::VectorXi::Zero(count);
  contact.tangential = Eigen::MatrixXi::Zero(count, 1);
  return contact;
}

TEST(FlankLines, FollowPlaceNotIndex) {
  reduction::ContactNodes contact = line(4);
  contact.position = Eigen::MatrixX3d::Zero(4, 3);
  contact.position.col(1) << 3.0, 1.0, 2.0, 0.0;
  const std::vector<std::vector<int>> lines = flank_lines(contact);
  ASSERT_EQ(lines.size(), 1u);
  // Along y: 3, 1, 2, 0; which end comes first is free.
  std::vector<int> found = lines[0];
  if (found.front() == 0) std::reverse(found.begin(), found.end());
  EXPECT_EQ(found, (std::vector<int>{3, 1, 2, 0}));
}

TEST(FlankLines, DoNotCrossFlanks) {
  reduction::ContactNodes contact = line(4);
  contact.group.resize(4);
  contact.group << 1, 0, 1, 0;
  EXPECT_EQ(flank_lines(contact), (std::vector<std::vector<int>>{{1, 3}, {0, 2}}));
}

}  // namespace
}  // namespace dovetail::wear
