// Sectors in space along lines through the design space, on one mesh topology: no jumps.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/verification/optimizer/sector_joint.hpp"

namespace dovetail::optimizer {
namespace {

struct Line {
  std::string key;
  double from, to;  ///< in the file's unit
};

void PrintTo(const Line& line, std::ostream* out) {
  *out << line.key;
}

class SectorSmoothness : public ::testing::TestWithParam<Line> {};

/// Off all places where answers are symmetric.
Scene everything() {
  Scene scene = testing::joint(kSector);
  scene.mesh.flank_elements = 4;
  scene.solid_mesh.slot_elements = 3;  // a crown along the slot has the same mean over each half
  scene.solver.modes = 8;
  for (const auto& [key, value] : std::vector<std::pair<std::string, double>>{{"geometry.skew_angle_deg", 8},
                                                                              {"geometry.stagger_deg", 12},
                                                                              {"geometry.twist_deg", 15},
                                                                              {"geometry.flank_crown_um", 1},
                                                                              {"geometry.axial_crown_um", 1}})
    set_parameter(scene, key, value);
  return scene;
}

const ModelBuilder& builder() {
  static const ModelBuilder instance(everything());
  return instance;
}

TEST_P(SectorSmoothness, FrequenciesAndPressuresDoNotJump) {
  constexpr Eigen::Index kPoints = 7, kFrequencies = 4;
  Eigen::MatrixXd answers;  // [answer, point]
  for (Eigen::Index k = 0; k < kPoints; ++k) {
    Scene scene = everything();
    const double share = static_cast<double>(k) / (kPoints - 1);
    set_parameter(scene, GetParam().key, (1 - share) * GetParam().from + share * GetParam().to);
    const CandidateModel model = builder().build(scene);
    ASSERT_TRUE(model.converged()) << model.status;
    ASSERT_FALSE(model.mesh.remeshed) << model.mesh.note;
    if (k == 0) answers.resize(kFrequencies + model.preload.pressure.size(), kPoints);
    answers.col(k) << model.reduction.glued_frequencies.head(kFrequencies), model.preload.pressure;
  }
  const Eigen::VectorXd range = answers.rowwise().maxCoeff() - answers.rowwise().minCoeff();
  const Eigen::VectorXd second =
      (answers.leftCols(kPoints - 2) - 2 * answers.middleCols(1, kPoints - 2) + answers.rightCols(kPoints - 2))
          .cwiseAbs()
          .rowwise()
          .maxCoeff();
  // A parabola with its vertex in the middle has a second difference of 2 / 9 of its range over seven points, a jump
  // by the whole range one of 1. Pressures have kinks where a node lifts off, hence one range for all of them.
  // Frequencies that the line hardly changes (crowns: by the stress alone) may move by the reduction's tolerance.
  for (Eigen::Index a = 0; a < kFrequencies; ++a)
    EXPECT_LT(second(a), 0.25 * range(a) + 1e-6 * answers(a, 0)) << "frequency " << a;
  const Eigen::Index nodes = answers.rows() - kFrequencies;
  EXPECT_GT(range.tail(nodes).maxCoeff(), 1e-3 * answers.col(0).tail(nodes).mean());
  EXPECT_LT(second.tail(nodes).maxCoeff(), 0.2 * range.tail(nodes).maxCoeff());
}

INSTANTIATE_TEST_SUITE_P(Lines, SectorSmoothness,
                         ::testing::Values(Line{"geometry.skew_angle_deg", 6, 10}, Line{"geometry.stagger_deg", 8, 16},
                                           Line{"geometry.flank_angle_deg", 48.5, 51},
                                           Line{"geometry.flank_crown_um", 0.5, 4},
                                           Line{"geometry.axial_crown_um", 1, 6}),
                         [](const ::testing::TestParamInfo<Line>& test) {
                           return test.param.key.substr(test.param.key.find('.') + 1);
                         });
}  // namespace
}  // namespace dovetail::optimizer
