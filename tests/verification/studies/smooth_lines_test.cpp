// The worn volume along lines through the quickstart's start design, and through one with hollow flanks: no steps that
// would lead a search astray.
#include <gtest/gtest.h>

#include <cstdio>
#include <ostream>
#include <string>
#include <vector>

#include "optimizer/evaluator.hpp"
#include "studies/program/engine/engine.hpp"
#include "studies/program/study_file/study.hpp"
#include "tests/benchmarks/largest_jump.hpp"

namespace dovetail::studies {
namespace {

struct Line {
  const char* key;
  double crown_um;  ///< of the flanks
  double limit;     ///< for the largest jump
};
void PrintTo(const Line& line, std::ostream* out) {
  *out << line.key << ", crown " << line.crown_um;
}

class SmoothLines : public ::testing::TestWithParam<Line> {};

TEST_P(SmoothLines, WornVolumeDoesNotJump) {
  constexpr int kPoints = 41;
  const Study study = load_study(QUICKSTART);
  const auto evaluator = scene_evaluator(study);
  for (const optimizer::DesignVariable& variable : study.problem.space.variables()) {
    if (variable.key != GetParam().key) continue;
    std::vector<double> volumes;
    for (int i = 0; i < kPoints; ++i) {
      optimizer::Scene scene = study.scene;
      optimizer::set_parameter(scene, "geometry.flank_crown_um", GetParam().crown_um);
      optimizer::set_parameter(scene, variable.key,
                               variable.lower + (variable.upper - variable.lower) * i / (kPoints - 1));
      const optimizer::Evaluation evaluation = evaluator->evaluate(scene, optimizer::kSearch).evaluation;
      ASSERT_TRUE(evaluation.converged()) << i << ": " << evaluation.status;
      volumes.push_back(evaluation.responses.at("asymptotic_wear_volume_m3"));
    }
    std::printf("%s: %.2e\n", variable.key.c_str(), largest_jump(volumes));
    EXPECT_LT(largest_jump(volumes), GetParam().limit);
    return;
  }
  FAIL() << "no variable of the study";
}

// Where wear begins along mismatch and crown the curve bends within few of the points, and zones are a node or two
// wide.
INSTANTIATE_TEST_SUITE_P(
    Quickstart, SmoothLines,
    ::testing::Values(Line{"geometry.flank_mismatch_um", 0, 0.02}, Line{"geometry.flank_crown_um", 0, 0.05},
                      Line{"geometry.neck_width_mm", 0, 0.005}, Line{"geometry.flank_mismatch_um", -2, 0.035},
                      Line{"geometry.neck_width_mm", -2, 0.005}, Line{"geometry.flank_angle_deg", -2, 0.005}));

}  // namespace
}  // namespace dovetail::studies
