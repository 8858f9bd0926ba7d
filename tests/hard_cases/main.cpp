#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <optional>
#include <string>

#include "numerics/process.hpp"
#include "tests/hard_cases/suite.hpp"

// Solves the hard cases and prints what became of them. Exit status 1 when a converged state is wrong.
int main(int argc, char** argv) {
  dovetail::numerics::prepare_process(argv);
  using namespace dovetail::hard_cases;
  CLI::App app("Hard cases of the steady state: each converges, checked independently, or says why not.");
  std::vector<std::string> only;
  std::string csv;
  std::optional<dovetail::contact::SlipReturn> slip_return;
  std::uint64_t seed = seed_of_run();
  bool quiet = false, without_each = false;
  app.add_option("--only", only, "families, or single problems as FAMILY/NUMBER");
  app.add_option("--csv", csv, "file for one line per problem");
  app.add_option_function<std::string>(
         "--slip-return",
         [&](const std::string& name) { slip_return = dovetail::named<dovetail::contact::SlipReturn>(name); },
         "first_order or second_order for all problems instead of their own")
      ->check(CLI::IsMember({"first_order", "second_order"}));
  app.add_option("--seed", seed, "of the fresh problems; default: DOVETAIL_SEED, or another one in every run");
  app.add_flag("--quiet", quiet, "no line per problem that did not converge");
  app.add_flag("--without-each", without_each, "also solve them without each single way to a solution");
  CLI11_PARSE(app, argc, argv);
  const auto asked = [&](const std::string& family, int index) {
    return only.empty() || std::any_of(only.begin(), only.end(), [&](const std::string& name) {
             return name == family || name == family + "/" + std::to_string(index);
           });
  };
  std::vector<Outcome> outcomes;
  std::vector<Score> scores;
  std::vector<Family> asked_of = families();
  for (Family& family : fresh_families(seed)) asked_of.push_back(std::move(family));
  fmt::print("Fresh problems: --seed {} repeats them.\n", seed);
  for (const Family& family : asked_of)
    for (int index = 0; index < family.count; ++index) {
      if (!asked(family.name, index)) continue;
      Problem problem = family.make(index);
      if (slip_return) problem.options.slip_return = *slip_return;
      outcomes.push_back(attempt(family, index, problem));
      if (only.empty()) spoil(problem, outcomes.back(), scores);
      if (!quiet) fmt::print("{}", failures({outcomes.back()}));
      std::fflush(stdout);
    }
  fmt::print("\n{}", table(outcomes));
  if (only.empty()) fmt::print("\n{}", table(scores));
  if (without_each) fmt::print("\n{}", marginal_table(asked_of, outcomes));
  if (!csv.empty()) std::ofstream(csv) << comma_separated(outcomes);
  return std::any_of(outcomes.begin(), outcomes.end(), [](const Outcome& o) { return !o.wrong.empty(); }) ? 1 : 0;
}
