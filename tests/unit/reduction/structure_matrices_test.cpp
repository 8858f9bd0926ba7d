#include "reduction/structure_matrices.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>

#include "core/errors.hpp"
#include "reduction/node_pairs.hpp"

namespace dovetail::reduction {
namespace {

using testing::HasSubstr;

/// Files in a folder of their own.
class Structure : public testing::Test {
 protected:
  Structure()
      : folder_(std::filesystem::path(testing::TempDir()) /
                ("structure_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()))) {
    std::filesystem::create_directories(folder_);
  }
  ~Structure() override {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }

  std::string file(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
    return (folder_ / name).string();
  }

  static std::string refusal(const std::string& stiffness, const std::string& mass = {}, const std::string& dofs = {}) {
    try {
      (void)read_structure(stiffness, mass, dofs);
      return {};
    } catch (const InputError& error) {
      return error.what();
    }
  }

  std::filesystem::path folder_;
};

/// K of nodes 7 (directions 1, 2) and 9 (direction 1).
const Eigen::Matrix3d kStiffness = (Eigen::Matrix3d() << 4, -1, 2, -1, 5, 0, 2, 0, 6).finished();
const std::vector<NodeDirection> kDofs{{7, 1}, {7, 2}, {9, 1}};

void expect_it(const StructureMatrices& read) {
  EXPECT_EQ(read.dofs, kDofs);
  EXPECT_EQ(Eigen::MatrixXd(read.stiffness), Eigen::MatrixXd(kStiffness));
}

TEST_F(Structure, IsTheSameInEveryFormat) {
  const std::string dofs = file("dofs", "7.1\n7.2\n9.1\n");
  expect_it(read_structure(
      file("lower.mtx", "** Abaqus\n7,1, 7,1, 4.0e0\n7,2,7,1,-1.\n 7,2, 7,2,5\n9,1,7,1,2\n9,1,9,1,6\n"), {}, {}));
  expect_it(read_structure(
      file("both.mtx", "7,1,7,1,4\n7,2,7,1,-1\n7,1,7,2,-1\n7,2,7,2,5\n9,1,7,1,2\n7,1,9,1,2\n9,1,9,1,6\n"), {}, {}));
  expect_it(
      read_structure(file("ccx.sti", "1 1  4.0000000000000e+00\n1 2 -1.0e+00\n2 2 5.\n1 3 2.\n3 3 6.D0\n"), {}, dofs));
  expect_it(read_structure(
      file("market.mtx",
           "%%MatrixMarket matrix coordinate real symmetric\n3 3 5\n1 1 4\n2 1 -1\n2 2 5\n3 1 2\n3 3 6\n"),
      {}, dofs));
  expect_it(read_structure(file("sub.mtx",
                                "**\n** GENERATION OF SUBSTRUCTURE\n*USER ELEMENT,NODES=          3,LINEAR\n"
                                "** ELEMENT NODES\n**         7,         7,         9,\n         1\n"
                                "         2,         2\n         3,         1\n*MATRIX,TYPE=STIFFNESS\n"
                                " 4.0E+00,\n-1.0E+00, 5.0E+00,\n 2.0E+00, 0.0E+00, 6.0E+00,\n"),
                           {}, {}));
}

TEST_F(Structure, OfASuperelementHasItsMassAndTheDirectionsOfEachNode) {
  const std::string path = file("z1.mtx",
                                "*USER ELEMENT, NODES= 2, LINEAR\n** ELEMENT NODES\n** 7, 9\n1, 2\n2, 1\n"
                                "*MATRIX,TYPE=STIFFNESS\n4, \n-1, 5\n2, 0, 6\n*MATRIX,TYPE=MASS\n1,\n0, 2\n0, 0, 3\n");
  const StructureMatrices read = read_structure(path, path, {});
  expect_it(read);
  EXPECT_EQ(Eigen::MatrixXd(read.mass), Eigen::MatrixXd(Eigen::Vector3d(1, 2, 3).asDiagonal()));
}

TEST_F(Structure, LeavesOutWhatIsHeld) {
  const StructureMatrices read =
      read_structure(file("k.mtx", "7,1,7,1,4\n7,2,7,1,-1\n7,2,7,2,1e36\n9,1,7,1,2\n9,1,9,1,6\n"),
                     file("m.mtx", "7,1,7,1,1\n9,1,9,1,3\n"), {});
  EXPECT_EQ(read.dofs, (std::vector<NodeDirection>{{7, 1}, {9, 1}}));
  EXPECT_EQ(Eigen::MatrixXd(read.stiffness), (Eigen::Matrix2d() << 4, 2, 2, 6).finished());
  EXPECT_EQ(Eigen::MatrixXd(read.mass), (Eigen::Matrix2d() << 1, 0, 0, 3).finished());
}

TEST_F(Structure, IsRefusedInOneSentence) {
  const std::string dofs = file("dofs", "7.1\n7.2\n");
  EXPECT_THAT(refusal((folder_ / "none").string()), HasSubstr("cannot be read"));
  EXPECT_THAT(refusal(file("a", "1 1 4\n")), HasSubstr("does not name its degrees of freedom; give dofs"));
  EXPECT_THAT(refusal(file("b", "1 1 4\n3 3 4\n"), {}, dofs), HasSubstr("b:2: matrix = 3: must be one of the 2 rows"));
  EXPECT_THAT(refusal(file("c", "1 1 4\n1 1 4\n"), {}, dofs),
              HasSubstr("c:2: matrix: must be an entry not listed before"));
  EXPECT_THAT(refusal(file("d", "1 1 4\n1 2 1\n2 1 3\n2 2 4\n"), {}, dofs), HasSubstr("must be symmetric"));
  EXPECT_THAT(refusal(file("e", "7,1,7,1,4\n"), file("f", "1 1 4\n"), {}),
              HasSubstr("must name its degrees of freedom as"));
  EXPECT_THAT(refusal(file("g", "1 2\n")), HasSubstr("g:1: matrix = 2 words"));
  EXPECT_THAT(refusal(file("h", "1 1 nan\n"), {}, dofs), HasSubstr("must be a finite number"));
  EXPECT_THAT(
      refusal(
          file("i", "*USER ELEMENT, NODES= 2, LINEAR\n** ELEMENT NODES\n** 7, 9\n1\n*MATRIX,TYPE=STIFFNESS\n4,\n-1\n")),
      HasSubstr("i: user element = 2 numbers: must be the triangle of 2 rows, 3"));
  EXPECT_THAT(refusal(file("j", "1 1 4\n"), {}, file("twice", "7.1\n7.1\n")),
              HasSubstr("names a direction of a node twice"));
}

TEST(NodePairs, TurnToOrthonormalDirectionsAndGlueAtZero) {
  const std::vector<NodeDirection> dofs{{1, 1}, {1, 2}, {1, 3}, {2, 1}, {2, 2}, {2, 3}, {3, 1}};
  const NodePairs pairs{
      .nodes = {1}, .against = {2}, .normal = Eigen::RowVector3d(0, 3, 4), .tangent = Eigen::MatrixXd()};
  const Eigen::MatrixXd t = relative_coordinates(dofs, pairs);
  ASSERT_EQ(t.rows(), 7);
  ASSERT_EQ(t.cols(), 7);
  // The rest: node 2 and node 3; with r = 0 node 1 goes with node 2.
  EXPECT_EQ(Eigen::MatrixXd(t.topLeftCorner(3, 4)),
            (Eigen::MatrixXd(3, 4) << Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero()).finished());
  const Eigen::Matrix3d turn = t.topRightCorner(3, 3);
  EXPECT_LT((turn.transpose() * turn - Eigen::Matrix3d::Identity()).norm(), 1e-15);
  EXPECT_LT((turn.col(0) - Eigen::Vector3d(0, 0.6, 0.8)).norm(), 1e-15);
  EXPECT_GT(turn.determinant(), 0.5);
}

TEST(NodePairs, AreRefusedTogether) {
  const std::vector<NodeDirection> dofs{{1, 1}, {1, 2}, {2, 1}, {2, 2}};
  const NodePairs pairs{.nodes = {1, 1, 5},
                        .against = {2, 9, 1},
                        .normal = (Eigen::MatrixXd(3, 2) << 0, 1, 0, 0, 1, 0).finished(),
                        .tangent = Eigen::MatrixXd()};
  try {
    (void)relative_coordinates(dofs, pairs);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(),
                testing::AllOf(HasSubstr("nodes[1] = 1: must not be listed twice"),
                               HasSubstr("normal[1]: must have a direction"),
                               HasSubstr("against[1] = 9: must be a node of the matrices"),
                               HasSubstr("nodes[2] = 5: must be a node that the matrices have in directions 1 to 2")));
  }
}

}  // namespace
}  // namespace dovetail::reduction
