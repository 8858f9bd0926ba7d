#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <iostream>

#include "tests/hard_cases/mutations.hpp"
#include "tests/hard_cases/suite.hpp"

namespace dovetail::hard_cases {
namespace {

// The checks of the hard cases have teeth: answers of the solver, tuned and fresh, spoiled by a hundredth of a node's
// largest force, are rejected by each check that is there for what was spoiled.
TEST(Oracle, RejectsSpoiledAnswersByEachCheckThatShould) {
  // Rates of one miss in fifty scatter from seed to seed: the same fresh problems in every run, unless asked for
  // others.
  const std::uint64_t seed = std::getenv("DOVETAIL_SEED") != nullptr ? seed_of_run() : 1;
  std::vector<Family> all = families();
  for (Family& family : fresh_families(seed)) all.push_back(std::move(family));
  std::cout << "fresh problems: DOVETAIL_SEED=" << seed << "\n";
  std::vector<Score> scores(mutations().size());
  for (const Family& family : all)
    for (int index = 0; index < family.count; ++index) {
      if (!chosen_for_spoiling(index)) continue;
      const Problem problem = family.make(index);
      if (problem.contact_mass || !problem.no_answer.empty()) continue;
      spoil(problem, attempt(family, index, problem), scores);
    }
  std::cout << table(scores);
  // Each check over all it has to see; and of one kind no more than 1 %, or one, since one in fifty is no rate.
  Score sum;
  for (std::size_t m = 0; m < mutations().size(); ++m)
    for (const Check check : mutations()[m].seen_by) {
      const auto c = static_cast<std::size_t>(check);
      EXPECT_GE(scores[m].shown[c], 30) << mutations()[m].name << " by " << name(check);
      EXPECT_LE(scores[m].shown[c] - scores[m].rejected[c], std::max(1.0, 0.01 * scores[m].shown[c]))
          << mutations()[m].name << " by " << name(check);
      sum.shown[c] += scores[m].shown[c];
      sum.rejected[c] += scores[m].rejected[c];
    }
  for (std::size_t c = 0; c < kChecks; ++c)
    EXPECT_GE(sum.rejected[c], 0.99 * sum.shown[c]) << name(static_cast<Check>(c));
}

}  // namespace
}  // namespace dovetail::hard_cases
