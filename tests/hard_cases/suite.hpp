#pragma once

#include <string>
#include <vector>

#include "core/status.hpp"
#include "paths/params.hpp"
#include "tests/hard_cases/mutations.hpp"
#include "tests/hard_cases/oracle.hpp"

namespace dovetail::hard_cases {

/// How one problem ended.
struct Outcome {
  std::string family;
  int index = 0;
  bool fresh = false;
  Status status = Status::iteration_limit;
  std::string thrown = {};  ///< message of an exception; none is expected
  std::string wrong = {};   ///< converged, and the independent check objects: why
  Claim claim = {};         ///< of converged states
  Verdict verdict = {};     ///< on it
  bool has_answer = true;   ///< false: proved by construction that there is none
  bool contact_mass = false;
  int nodes = 0, unknowns = 0, iterations = 0;
  double milliseconds = 0, residual = 0, penalty_ratio = 1;
  steady::Way way = steady::Way::none;  ///< that led to the state

  [[nodiscard]] std::string id() const { return family + "/" + std::to_string(index); }
  [[nodiscard]] bool converged() const { return status == Status::converged && thrown.empty(); }
};

/// Solves and examines one problem.
[[nodiscard]] Outcome attempt(const Family& family, int index, const Problem& problem,
                              const paths::WayParams& ways = {});

/// One problem in a dozen of each family, by turns of either rule for slip.
[[nodiscard]] bool chosen_for_spoiling(int index);
/// Adds every kind of spoiled claim made of the outcome to `scores`, when it is a chosen one, small, massless,
/// converged.
void spoil(const Problem& problem, const Outcome& outcome, std::vector<Score>& scores);

/// One line per family and their sums, and one per way to a solution: what it earned.
[[nodiscard]] std::string table(const std::vector<Outcome>& outcomes);
/// One line per way and kind of problems: what it earned, and what is lost, gained and paid when it alone is left out.
/// `outcomes` are those of all ways; those that earlier ways led to are the same without it and not solved again.
[[nodiscard]] std::string marginal_table(const std::vector<Family>& families, const std::vector<Outcome>& outcomes);
/// One line per problem that did not converge or is wrong.
[[nodiscard]] std::string failures(const std::vector<Outcome>& outcomes);
/// One line of a comma-separated table per problem, with a header.
[[nodiscard]] std::string comma_separated(const std::vector<Outcome>& outcomes);

}  // namespace dovetail::hard_cases
