#include <gtest/gtest.h>

#include <iostream>

#include "tests/hard_cases/mutations.hpp"
#include "tests/hard_cases/suite.hpp"

namespace dovetail::hard_cases {
namespace {

// The checks of the hard cases have teeth: answers of the solver, tuned and fresh, spoiled by a hundredth of a node's
// largest force are rejected by each check that is there for what was spoiled. Not all are: a node may balance the
// change in what it does not depend on, and where it slides turning at the first order of the step, the finer march
// cannot tell it from the cost of the step.
TEST(Oracle, RejectsSpoiledAnswersByEachCheckThatShould) {
  std::vector<Family> all = families();
  for (Family& family : fresh_families(seed_of_run())) all.push_back(std::move(family));
  std::cout << "fresh problems: DOVETAIL_SEED=" << seed_of_run() << "\n";
  const std::vector<Score> scores = spoiled(all);
  std::cout << table(scores);
  for (std::size_t m = 0; m < mutations().size(); ++m) {
    EXPECT_GE(scores[m].shown, 30) << mutations()[m].name;
    for (const Check check : mutations()[m].seen_by)
      EXPECT_GE(scores[m].rejected[static_cast<std::size_t>(check)], 0.99 * scores[m].shown)
          << mutations()[m].name << " by " << name(check);
  }
}

}  // namespace
}  // namespace dovetail::hard_cases
