#include <gtest/gtest.h>

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
    outcomes.push_back(attempt(family.name, index, family.make(index)));
    const Outcome& outcome = outcomes.back();
    EXPECT_EQ(outcome.wrong, "") << outcome.id();
    EXPECT_EQ(outcome.thrown, "") << outcome.id();
  }
  std::cout << table(outcomes) << failures(outcomes);
}

INSTANTIATE_TEST_SUITE_P(Family, HardCases, testing::ValuesIn(families()),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace dovetail::hard_cases
