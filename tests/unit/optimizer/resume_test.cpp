#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "bowl.hpp"
#include "core/errors.hpp"
#include "optimizer/journal/fingerprint.hpp"
#include "optimizer/search/run.hpp"
#include "scratch_file.hpp"

namespace dovetail::optimizer {
namespace {

/// The bowl with everything that can go wrong: a broken rule in one corner, failures in a strip, one NaN.
Evaluation rough(std::span<const double> x) {
  if (x[0] + x[1] < 2) return broken((2 - x[0] - x[1]) / 4);
  if (x[1] > 8.5) return failed();
  Evaluation e = bowl(x);
  if (x[0] > 2.5) e.responses["bowl"] = std::nan("");
  return e;
}

void expect_same_run(const OptimizationResult& a, const OptimizationResult& b) {
  ASSERT_EQ(a.evaluations.size(), b.evaluations.size());
  for (std::size_t i = 0; i < a.evaluations.size(); ++i) {
    ASSERT_EQ(a.evaluations[i].x, b.evaluations[i].x) << i;
    ASSERT_EQ(a.evaluations[i].evaluation.status, b.evaluations[i].evaluation.status) << i;
    ASSERT_EQ(a.evaluations[i].evaluation.constraints, b.evaluations[i].evaluation.constraints) << i;
  }
  EXPECT_EQ(a.best, b.best);
  EXPECT_EQ(a.status, b.status);
  EXPECT_EQ(a.message, b.message);
}

class Resume : public ScratchFile {};

class ResumeOf : public ScratchFile, public ::testing::WithParamInterface<Algorithm> {};

TEST_P(ResumeOf, GivesTheSameBitsWhereverTheRunWasKilled) {
  const Problem problem = bowl_problem();
  OptimizerOptions options = bowl_options(GetParam());
  options.max_evaluations = 30;
  const std::string key = fingerprint(problem, options);
  OptimizationResult reference;
  {
    Journal journal = Journal::create(file, key);
    reference = run_optimization(problem, rough, options, {.journal = &journal});
  }
  const std::string whole = contents();
  std::vector<std::size_t> cuts;
  for (std::size_t at = whole.find('\n'); at != std::string::npos; at = whole.find('\n', at + 1)) {
    cuts.push_back(at + 1);                               // between two records
    cuts.push_back(std::min(whole.size(), at + 1 + 40));  // within the next one
    if (at > 0) cuts.push_back(at);                       // only the newline is missing
  }
  // Everywhere for one algorithm; the others show by every seventh place that they repeat themselves.
  const std::size_t stride = GetParam() == Algorithm::cobyla ? 1 : 7;
  for (std::size_t place = 0; place < cuts.size(); place += stride) {
    const std::size_t cut = cuts[place];
    overwrite(whole.substr(0, cut));
    Journal journal = Journal::resume(file, key);
    const std::size_t kept = journal.size();
    const OptimizationResult resumed = run_optimization(problem, rough, options, {.journal = &journal});
    expect_same_run(reference, resumed);
    EXPECT_EQ(resumed.statistics.replayed, static_cast<int>(kept));
    EXPECT_EQ(resumed.statistics.unused_records, 0);
    ASSERT_EQ(contents(), whole) << "cut at " << cut;
  }
}

INSTANTIATE_TEST_SUITE_P(Optimizer, ResumeOf, ::testing::ValuesIn(all_algorithms()),
                         [](const auto& parameter) { return std::string(to_string(parameter.param)); });

TEST_F(Resume, ContinuesWithALargerBudgetAsIfItHadBeenThereFromTheStart) {
  const Problem problem = bowl_problem();
  OptimizerOptions options = bowl_options(Algorithm::cobyla);
  options.step_tolerance = 1e-6;
  options.max_evaluations = 50;
  const OptimizationResult reference = run_optimization(problem, rough, options);
  for (const int first : {1, 4, 20}) {
    std::filesystem::remove(file);
    options.max_evaluations = first;
    const std::string key = fingerprint(problem, options);
    {
      Journal journal = Journal::create(file, key);
      EXPECT_EQ(run_optimization(problem, rough, options, {.journal = &journal}).status, Status::iteration_limit);
    }
    options.max_evaluations = 50;
    ASSERT_EQ(fingerprint(problem, options), key);
    Journal journal = Journal::resume(file, key);
    const OptimizationResult resumed = run_optimization(problem, rough, options, {.journal = &journal});
    EXPECT_EQ(resumed.statistics.replayed, first);
    expect_same_run(reference, resumed);
  }
}

TEST_F(Resume, ComputesNothingWhenTheRunWasComplete) {
  const Problem problem = bowl_problem();
  const OptimizerOptions options = bowl_options(Algorithm::cobyla);
  {
    Journal journal = Journal::create(file, "k");
    static_cast<void>(run_optimization(problem, rough, options, {.journal = &journal}));
  }
  Journal journal = Journal::resume(file, "k");
  const Evaluator never = [](std::span<const double>) -> Evaluation { throw std::logic_error("computed again"); };
  const OptimizationResult again = run_optimization(problem, never, options, {.journal = &journal});
  EXPECT_EQ(again.statistics.computed, 0);
  for (const Candidate& candidate : again.evaluations) EXPECT_TRUE(candidate.replayed);
}

TEST_F(Resume, IsNotMovedByTimings) {
  const Problem problem = bowl_problem();
  const OptimizerOptions options = bowl_options(Algorithm::bobyqa);
  double clock = 1;
  const Evaluator timed = [&](std::span<const double> x) {
    Evaluation e = rough(x);
    e.timings_s["total"] = clock *= 1.7;
    return e;
  };
  expect_same_run(run_optimization(problem, timed, options), run_optimization(problem, timed, options));
}

TEST(Fingerprint, ChangesWithEverythingThatMovesCandidates) {
  const Problem problem = bowl_problem();
  const OptimizerOptions options;
  const std::string key = fingerprint(problem, options, "physics");
  EXPECT_NE(fingerprint(problem, options, "other physics"), key);
  Problem moved = problem;
  moved.constraints[0].upper = 6.5;
  EXPECT_NE(fingerprint(moved, options, "physics"), key);
  moved = problem;
  moved.objective[0].absolute = true;
  EXPECT_NE(fingerprint(moved, options, "physics"), key);
  OptimizerOptions changed;
  changed.seed = 2;
  EXPECT_NE(fingerprint(problem, changed, "physics"), key);
  changed = {};
  changed.departures = false;
  changed.max_evaluations = 7;
  EXPECT_EQ(fingerprint(problem, changed, "physics"), key);
}

}  // namespace
}  // namespace dovetail::optimizer
