#include "optimizer/problem/optimizer_options.hpp"

#include <algorithm>
#include <cmath>

namespace dovetail::optimizer {

namespace {

double noise_of(const OptimizerOptions& options) {
  return options.noise > 0 ? options.noise : NoiseParams{}.unknown;
}

using O = OptimizerOptions;
using Fields = std::vector<Field<O>>;

/// How the search moves and when it ends.
Fields fields_of_the_search() {
  constexpr Range share{.lower = 0, .upper = 0.5, .lower_open = true};
  Fields fields{
      {.key = "algorithm", .member = &O::algorithm, .help = "Search algorithm."},
      {.key = "max_evaluations",
       .member = &O::max_evaluations,
       .range = {.lower = 1},
       .help = "Largest number of different candidates, start and scan included."},
      {.key = "time_limit_s",
       .member = &O::time_limit,
       .range = kNonNegative,
       .help =
           "Time of a run, in s, after which no candidate is begun; what is handed over is computed all the same, and "
           "--resume goes on; 0: no limit. That of one evaluation is solver.time_limit_s."},
      {.key = "scan_evaluations",
       .member = &O::scan_evaluations,
       .range = kNonNegative,
       .help = "Latin-hypercube candidates before the algorithm, which starts from the best of them."},
      {.key = "population",
       .member = &O::population,
       .range = {.lower = PopulationParams{}.least, .upper = 10000, .zero = "as many as suit the number of variables"},
       .help = "Candidates in a generation of cmaes, de and nsga2, which are computed at once."},
      {.key = "front_points",
       .member = &O::front_points,
       .range = {.lower = 3, .upper = 1000},
       .help =
           "Several objectives without weights: points of their front that are computed with bars. Algorithms other "
           "than nsga2 run as often to find it."},
      {.key = "seed", .member = &O::seed, .range = kNonNegative, .help = "Same seed, same candidates."},
      {.key = "tolerance",
       .member = &O::tolerance,
       .range = kPositive,
       .help = "Relative change of the objective at which gradient methods stop."},
      {.key = "step_tolerance",
       .member = &O::step_tolerance,
       .range = {.lower = 0, .upper = 0.1, .lower_open = true},
       .help = "Step, as a fraction of each variable's range, at which the algorithm stops."},
      {.key = "noise",
       .member = &O::noise,
       .range = {.lower = 0, .upper = 0.5},
       .help = "Relative noise of the responses; sets finite-difference steps and the smallest useful step. 0: the "
               "error bar of the objective at the start."},
      {.key = "initial_step",
       .member = &O::initial_step,
       .range = share,
       .help = "First step, as a fraction of each variable's range."},
      {.key = "restarts",
       .member = &O::restarts,
       .range = kNonNegative,
       .help = "Runs of the algorithm again from the best candidate while budget is left."},
      {.key = "restart_factor",
       .member = &O::restart_factor,
       .range = {.lower = 0, .upper = 1, .lower_open = true},
       .help = "First step of a restart by that of the run before."},
      {.key = "difference", .member = &O::difference, .help = "Finite differences of gradient methods."},
  };
  return fields;
}

/// What is asked of a candidate, and of the best ones once the search is over.
Fields fields_of_candidates() {
  Fields fields{
      {.key = "constraint_tolerance",
       .member = &O::constraint_tolerance,
       .range = kNonNegative,
       .help = "The best design keeps every normalised constraint at or below this."},
      {.key = "constraint_margin",
       .member = &O::constraint_margin,
       .range = kNonNegative,
       .help = "Algorithms aim at normalised constraints at or below minus this."},
      {.key = "responses",
       .member = &O::responses,
       .help = "What a candidate answers with: needed stops after the stage that the last response of objective and "
               "constraints takes, all goes through wear to the worn resonance."},
      {.key = "finer_meshes",
       .member = &O::finer_meshes,
       .range = {.lower = 0, .upper = 4},
       .help = "Meshes, each with twice as many edges along the flanks as the last, on which the best design must keep "
               "its limits; in space 1 unless given."},
      {.key = "verify",
       .member = &O::verify,
       .range = {.lower = 0, .upper = 100},
       .help = "Best designs that `run` verifies after the search: by the full history at its settings, and directly "
               "at finer "
               "ones."},
      {.key = "departures",
       .member = &O::departures,
       .help = "After the search best design and start are looked at with other friction, force, speed and mismatch."},
      {.key = "verify_accuracy",
       .member = &O::verify_accuracy,
       .range = {.lower = kAccuracyRange.lower, .upper = kAccuracyRange.upper, .zero = "settings of the search"},
       .help = "Bar over value of every response that objective and constraints name, for which settings are chosen "
               "once more, at the best design: start and best design are recorded with these."},
  };
  return fields;
}

/// The first and then the second.
Fields joined(Fields first, const Fields& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

}  // namespace

bool has_population(Algorithm algorithm) {
  return algorithm == Algorithm::cmaes || algorithm == Algorithm::de || algorithm == Algorithm::nsga2;
}

int population_of(const OptimizerOptions& options, std::size_t variables) {
  constexpr PopulationParams kParams;
  if (!has_population(options.algorithm)) return 0;
  if (options.population > 0) return options.population;
  const auto n = static_cast<double>(variables);
  if (options.algorithm == Algorithm::nsga2) return kParams.of_nsga2;
  if (options.algorithm == Algorithm::de) return std::max(kParams.least, static_cast<int>(kParams.of_de * n));
  return std::max(kParams.least, 4 + static_cast<int>(3 * std::log(n)));  // [Hansen 2006]
}

int scan_size(const OptimizerOptions& options, std::size_t variables) {
  // As an algorithm of its own the scan takes the whole budget unless told otherwise.
  if (options.algorithm == Algorithm::scan && options.scan_evaluations == 0) return options.max_evaluations - 1;
  // With the start it is their first generation.
  const bool first = options.algorithm == Algorithm::de || options.algorithm == Algorithm::nsga2;
  return first ? std::max(options.scan_evaluations, population_of(options, variables) - 1) : options.scan_evaluations;
}

std::vector<Violation> contradictions(const OptimizerOptions& options, bool front) {
  std::vector<Violation> found;
  const bool nsga2 = options.algorithm == Algorithm::nsga2;
  const auto wrong = [&](const char* key, std::string value, std::string allowed) {
    found.push_back({.file = {}, .key = key, .value = std::move(value), .allowed = std::move(allowed)});
  };
  if (nsga2 && !front)
    wrong("optimizer.algorithm", "nsga2",
          "finds a front and needs several [[objective]] without weight; of one objective, or a weighted sum, take "
          "another algorithm");
  constexpr int kQuartets = PopulationParams{}.quartets;
  if (nsga2 && options.population % kQuartets != 0)
    wrong("optimizer.population", std::to_string(options.population),
          "must be a multiple of " + std::to_string(kQuartets) + " with algorithm = \"nsga2\"");
  if (options.population > 0 && !has_population(options.algorithm))
    wrong("optimizer.population", std::to_string(options.population),
          "has a meaning with algorithm = \"cmaes\", \"de\" or \"nsga2\" alone");
  return found;
}

double difference_step(const OptimizerOptions& options) {
  const double noise = noise_of(options);
  const double step = options.difference == Difference::central ? std::cbrt(3 * noise) : 2 * std::sqrt(noise);
  return std::clamp(step, 1e-7, 0.1);
}

double stopping_step(const OptimizerOptions& options) {
  return std::min(std::max(options.step_tolerance, 0.1 * std::sqrt(noise_of(options))), options.initial_step / 2);
}

}  // namespace dovetail::optimizer

template <>
std::span<const dovetail::Field<dovetail::optimizer::OptimizerOptions>>
dovetail::option_table<dovetail::optimizer::OptimizerOptions>() {
  static const auto table = optimizer::joined(optimizer::fields_of_the_search(), optimizer::fields_of_candidates());
  return table;
}
