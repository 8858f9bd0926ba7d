#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "optimizer/search/run.hpp"
#include "tests/verification/optimizer/random_search.hpp"

namespace dovetail::optimizer {
namespace {

/// Behaves like the worn volume of a dovetail over flank mismatch and crown: a bowl with its minimum inside, cut into
/// teeth of up to 10 % where contact nodes join or leave the worn set, while the amplitude rises as the wear falls.
Evaluation worn(std::span<const double> x) {
  const double bowl = 0.1 + std::pow((x[0] - 17) / 15, 2) + 0.5 * std::pow((x[1] - 5) / 8, 2);
  const double nodes = 40 * std::sqrt(bowl);
  Evaluation e;
  e.responses["asymptotic_wear_volume_m3"] = 1e-10 * bowl * (1 + 0.1 * (nodes - std::floor(nodes) - 0.5));
  e.responses["peak_amplitude_m"] = 8e-3 * (1 + 0.05 * (1 - bowl));
  return e;
}

Problem study() {
  Problem problem;
  problem.space = DesignSpace({{.key = "geometry.flank_mismatch_um", .lower = -5, .upper = 25, .start = 0},
                               {.key = "geometry.flank_crown_um", .lower = -3, .upper = 10, .start = 0}});
  problem.objective = {{.response = "asymptotic_wear_volume_m3"}};
  problem.constraints = {{.response = "peak_amplitude_m", .lower = {}, .upper = 8.5e-3}};
  return problem;
}

class NoisyWear : public ::testing::TestWithParam<Algorithm> {};

TEST_P(NoisyWear, ComesWithinTheNoiseOfTheBestDesign) {
  OptimizerOptions options;
  options.algorithm = GetParam();
  options.max_evaluations = 80;
  options.scan_evaluations = 12;
  options.noise = 1e-3;
  const OptimizationResult result = run_optimization(study(), worn, options);
  ASSERT_TRUE(result.best);
  // The bowl's least value is 0.1, a tooth is 10 % of it high; a local search may rest two teeth away from the bottom,
  // where nodes = 40 sqrt(0.1) + 2 = 14.65 and bowl = 0.134. The start has 1.58.
  const double best = result.evaluations[*result.best].judgement.objective;
  EXPECT_LE(best, 1e-10 * 0.134 * 1.05) << result.message;
  EXPECT_LE(result.evaluations.size(), 80U);
}

INSTANTIATE_TEST_SUITE_P(Optimizer, NoisyWear,
                         ::testing::Values(Algorithm::cobyla, Algorithm::bobyqa, Algorithm::neldermead,
                                           Algorithm::sbplx, Algorithm::crs2, Algorithm::direct_l),
                         [](const auto& parameter) { return std::string(to_string(parameter.param)); });

TEST(NoisyWear, IsFoundBetterByASearchThanByAsManyRandomDesigns) {
  OptimizerOptions options;
  options.max_evaluations = 60;
  options.scan_evaluations = 10;
  options.noise = 1e-3;
  const OptimizationResult searched = run_optimization(study(), worn, options);
  const std::optional<Candidate> random = best_random(study(), worn, 60, options);
  ASSERT_TRUE(searched.best && random);
  EXPECT_LT(searched.evaluations[*searched.best].judgement.objective, random->judgement.objective);
}

}  // namespace
}  // namespace dovetail::optimizer
