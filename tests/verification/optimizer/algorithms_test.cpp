#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "known_problems.hpp"
#include "tests/unit/optimizer/bowl.hpp"

namespace dovetail::optimizer {
namespace {

/// What an algorithm is expected to reach: the best feasible objective at most `excess` above the optimum.
struct Expectation {
  Algorithm algorithm;
  int evaluations;
  double smooth_excess;  ///< on Hock-Schittkowski 22 and 35 (objective 1 and 1/9, about 1 and 2.25 at the start)
  double valley_excess;  ///< on Rosenbrock's valley (24.2 at the start)
};

void PrintTo(const Expectation& e, std::ostream* stream) {
  *stream << to_string(e.algorithm);
}

class EveryAlgorithm : public ::testing::TestWithParam<Expectation> {
 protected:
  [[nodiscard]] OptimizerOptions options() const {
    OptimizerOptions options;
    options.algorithm = GetParam().algorithm;
    options.max_evaluations = GetParam().evaluations;
    options.noise = 1e-12;
    options.tolerance = 1e-9;
    options.step_tolerance = 1e-6;
    options.constraint_margin = 1e-6;
    options.restarts = 5;
    return options;
  }
  void reaches_optimum(const KnownProblem& known, double excess) {
    const OptimizationResult result = run_optimization(known.problem, known.evaluator, options());
    ASSERT_TRUE(result.best) << result.message;
    const Candidate& best = result.evaluations[*result.best];
    EXPECT_TRUE(best.judgement.feasible);
    for (const double c : best.judgement.constraints) EXPECT_LE(c, 0);
    EXPECT_LE(best.judgement.objective, known.value + excess)
        << result.message << " after " << result.evaluations.size() << " evaluations";
    // No feasible point is below the optimum: the judge would be wrong otherwise.
    EXPECT_GE(best.judgement.objective, known.value - 1e-12);
    EXPECT_LE(result.evaluations.size(), static_cast<std::size_t>(GetParam().evaluations));
  }
};

TEST_P(EveryAlgorithm, FindsTheVertexOfTwoConstraints) {
  reaches_optimum(hock_schittkowski_22(), GetParam().smooth_excess);
}

TEST_P(EveryAlgorithm, FindsTheOptimumOnAPlane) {
  reaches_optimum(hock_schittkowski_35(), GetParam().smooth_excess);
}

TEST_P(EveryAlgorithm, FollowsTheValley) {
  reaches_optimum(rosenbrock(), GetParam().valley_excess);
}

TEST_P(EveryAlgorithm, GivesTheSameBitsForTheSameSeed) {
  const KnownProblem known = hock_schittkowski_22();
  OptimizerOptions few = options();
  few.max_evaluations = std::min(few.max_evaluations, 200);
  few.scan_evaluations = 5;
  const OptimizationResult one = run_optimization(known.problem, known.evaluator, few);
  const OptimizationResult two =
      run_optimization(known.problem, known.evaluator, few, {.many = in_batches(known.evaluator, 2)});
  ASSERT_EQ(one.evaluations.size(), two.evaluations.size());
  for (std::size_t i = 0; i < one.evaluations.size(); ++i) EXPECT_EQ(one.evaluations[i].x, two.evaluations[i].x);
  EXPECT_EQ(one.best, two.best);
}

INSTANTIATE_TEST_SUITE_P(
    Optimizer, EveryAlgorithm,
    // Local methods end within the constraint margin times the multipliers (1e-6 times about 2)
    // of the optimum; linear models (cobyla) creep along a curved valley; forward differences of
    // step 2e-6 shift its floor by about 5e-6; the global methods are held to a few per cent.
    ::testing::Values(Expectation{Algorithm::cobyla, 1000, 1e-5, 0.5}, Expectation{Algorithm::bobyqa, 2000, 1e-5, 1e-6},
                      Expectation{Algorithm::neldermead, 3000, 1e-5, 1e-6},
                      Expectation{Algorithm::sbplx, 4000, 1e-5, 1e-4}, Expectation{Algorithm::isres, 5000, 5e-2, 1e-2},
                      Expectation{Algorithm::direct_l, 3000, 5e-2, 1e-2},
                      Expectation{Algorithm::crs2, 3000, 1e-3, 1e-3}, Expectation{Algorithm::mma, 3000, 1e-5, 1e-2},
                      Expectation{Algorithm::slsqp, 1000, 1e-5, 2e-5}, Expectation{Algorithm::ipopt, 1000, 1e-5, 2e-5},
                      Expectation{Algorithm::cmaes, 3000, 1e-3, 1e-6}, Expectation{Algorithm::de, 3000, 1e-3, 1e-4},
                      Expectation{Algorithm::scan, 1000, 0.5, 0.5}),
    [](const auto& parameter) { return std::string(to_string(parameter.param.algorithm)); });

/// Without mma, whose separable models creep along a curved valley whatever the gradient.
class EveryCurvatureMethod : public ::testing::TestWithParam<Algorithm> {};

TEST_P(EveryCurvatureMethod, IsMoreAccurateWithCentralDifferences) {
  const KnownProblem known = rosenbrock();
  OptimizerOptions options;
  options.algorithm = GetParam();
  options.max_evaluations = 4000;
  options.noise = 1e-12;
  options.tolerance = 1e-12;
  options.step_tolerance = 1e-7;
  options.difference = Difference::central;
  const OptimizationResult result = run_optimization(known.problem, known.evaluator, options);
  ASSERT_TRUE(result.best);
  // Truncation is of order h^2 = 2e-8 of the third derivative against h = 2e-6 of the second: the floor of the valley
  // is met two orders better than the 5e-6 of forward differences.
  EXPECT_LE(result.evaluations[*result.best].judgement.objective, 5e-8) << result.message;
}

INSTANTIATE_TEST_SUITE_P(Optimizer, EveryCurvatureMethod, ::testing::Values(Algorithm::slsqp, Algorithm::ipopt),
                         [](const auto& parameter) { return std::string(to_string(parameter.param)); });

}  // namespace
}  // namespace dovetail::optimizer
