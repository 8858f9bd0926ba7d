#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>

#include "tests/hard_cases/suite.hpp"

namespace dovetail::hard_cases {
namespace {

class HardCases : public testing::TestWithParam<Family> {};

// None silently wrong: every problem converges to a state that an independent march of the contact law confirms, or
// ends with a status that says why not. Problems without a steady state must not converge.
TEST_P(HardCases, AreSolvedOrClassified) {
  const Family& family = GetParam();
  std::vector<Outcome> outcomes;
  for (int index = 0; index < family.count; ++index) {
    outcomes.push_back(attempt(family, index, family.make(index)));
    const Outcome& outcome = outcomes.back();
    EXPECT_EQ(outcome.wrong, "") << outcome.id();
    EXPECT_EQ(outcome.thrown, "") << outcome.id();
  }
  // Where a steady state exists nearly all are found; with mass on contacts that lift off there may be none.
  if (outcomes.front().has_answer) {
    const auto converged =
        std::count_if(outcomes.begin(), outcomes.end(), [](const Outcome& o) { return o.converged(); });
    EXPECT_GE(converged, outcomes.front().contact_mass ? family.count * 9 / 10 : family.count * 98 / 100);
  }
  std::cout << table(outcomes) << failures(outcomes);
}

INSTANTIATE_TEST_SUITE_P(Family, HardCases, testing::ValuesIn(families()),
                         [](const auto& param_info) { return param_info.param.name; });

}  // namespace
}  // namespace dovetail::hard_cases
