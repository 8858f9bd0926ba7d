#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tests/hard_cases/oracle.hpp"
#include "tests/hard_cases/random.hpp"

namespace dovetail::hard_cases {

/// A way to spoil a claim by a hundredth of the largest force of one of its nodes (or of that node's gap), and the
/// checks that have to see it.
struct Mutation {
  std::string name;
  std::vector<Check> seen_by;
  /// The spoiled claim, or nothing when the state has no place for this: no node that slips, no second node... Nodes
  /// are passed over whose hundredth is below `floor` N.
  std::optional<Claim> (*apply)(const Problem& problem, const Claim& claim, double floor, Random& random);
};

[[nodiscard]] const std::vector<Mutation>& mutations();

/// How many spoiled claims each check was shown and rejected.
struct Score {
  std::array<int, kChecks> shown = {}, rejected = {};
};

/// One spoiled claim of every kind that applies is added to `scores` [mutations()]; `verdict` is on the claim as it
/// was. The hundredth has to be a thousand times what the tolerance of the solve leaves open; and the finer march is
/// shown those claims only where large steps cost less than a fifth of it.
void spoil(const Problem& problem, const Claim& claim, const Verdict& verdict, Random& random,
           std::vector<Score>& scores);

/// One line per mutation, one column per check that has to see it: rejected / shown.
[[nodiscard]] std::string table(const std::vector<Score>& scores);

}  // namespace dovetail::hard_cases
