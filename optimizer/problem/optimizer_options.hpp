#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "core/enum_names.hpp"
#include "core/options.hpp"

namespace dovetail::optimizer {

/// What searches, see nlopt_search.hpp, ipopt_search.hpp and pagmo_search.hpp.
enum class Algorithm {
  cobyla,
  bobyqa,
  neldermead,
  sbplx,
  isres,
  direct_l,
  crs2,
  mma,
  slsqp,
  ipopt,
  cmaes,
  de,
  nsga2,  ///< of a front
  scan,   ///< a Latin hypercube and nothing after it
};
constexpr EnumNames<Algorithm, 14> enum_names(Algorithm) {
  return {{{Algorithm::cobyla, "cobyla"},
           {Algorithm::bobyqa, "bobyqa"},
           {Algorithm::neldermead, "neldermead"},
           {Algorithm::sbplx, "sbplx"},
           {Algorithm::isres, "isres"},
           {Algorithm::direct_l, "direct_l"},
           {Algorithm::crs2, "crs2"},
           {Algorithm::mma, "mma"},
           {Algorithm::slsqp, "slsqp"},
           {Algorithm::ipopt, "ipopt"},
           {Algorithm::cmaes, "cmaes"},
           {Algorithm::de, "de"},
           {Algorithm::nsga2, "nsga2"},
           {Algorithm::scan, "scan"}}};
}
[[nodiscard]] constexpr std::string_view to_string(Algorithm algorithm) {
  return name_of(algorithm);
}

/// Finite differences of gradient methods.
enum class Difference { forward, central };
constexpr EnumNames<Difference, 2> enum_names(Difference) {
  return {{{Difference::forward, "forward"}, {Difference::central, "central"}}};
}
[[nodiscard]] constexpr std::string_view to_string(Difference difference) {
  return name_of(difference);
}

/// Which responses a candidate of the search answers with. What objective and constraints do not name may need stages
/// of the computation that they do not.
enum class Answers { needed, all };
constexpr EnumNames<Answers, 2> enum_names(Answers) {
  return {{{Answers::needed, "needed"}, {Answers::all, "all"}}};
}
[[nodiscard]] constexpr std::string_view to_string(Answers answers) {
  return name_of(answers);
}

/// Section [optimizer] of a study file. Lengths are in unit coordinates (fractions of a variable's range).
struct OptimizerOptions {
  Algorithm algorithm = Algorithm::cobyla;
  int max_evaluations = 100;     ///< >= 1; different candidates, start and scan included
  int scan_evaluations = 0;      ///< >= 0; Latin-hypercube candidates before the local algorithm
  int seed = 1;                  ///< >= 0
  int population = 0;            ///< candidates of a generation of cmaes, de, nsga2; 0: by the number of variables
  int front_points = 12;         ///< >= 3; of a front, handed over with bars; runs of a local algorithm that make it
  double time_limit = 0;         ///< >= 0; s of the run, after which no evaluation begins; 0: none
  double tolerance = 1e-6;       ///< > 0; relative change of the objective at which gradient methods stop
  double step_tolerance = 1e-4;  ///< > 0, <= 0.1; step at which a local algorithm stops
  double noise =
      0;  ///< >= 0, <= 0.5; relative noise of the responses, sets difference steps and stopping; 0: not known
  double initial_step = 0.2;        ///< > 0, <= 0.5; first step (trust radius) of a local algorithm
  int restarts = 2;                 ///< >= 0; local runs again from the best, with budget left
  double restart_factor = 0.5;      ///< > 0, <= 1; first step of a restart by that of the run before
  double constraint_tolerance = 0;  ///< >= 0; the best design keeps c <= this
  double constraint_margin = 1e-4;  ///< >= 0; algorithms aim at c <= -margin, so that they end on the right side
  Difference difference = Difference::forward;
  Answers responses = Answers::needed;
  int finer_meshes =
      2;           ///< >= 0; meshes, each twice as fine as the last, on which the best design must keep its limits
  int verify = 3;  ///< >= 0; best designs verified by the full wear history after the search
  bool departures = true;      ///< after the search: how far do start and best design hold where the scene is another
  double verify_accuracy = 0;  ///< bar over value of what is handed over; 0: at the settings of the search
};

/// Noise where it is not given.
struct NoiseParams {
  double unknown = 1e-6;      ///< nothing is known of it; never less follows from bars
  double unknown_bar = 0.02;  ///< the objective has no bar, or there is nothing of it at the start
};
static_assert(NoiseParams{}.unknown < NoiseParams{}.unknown_bar, "in doubt longer steps");

/// Generations of algorithms that have them.
struct PopulationParams {
  int least = 5;      ///< as pagmo takes
  int of_de = 5;      ///< times the number of variables; Storn and Price advise 5 to 10
  int of_nsga2 = 16;  ///< the hypervolume of a few hundred evaluations is largest for 12 to 20
  int quartets = 4;   ///< nsga2 has tournaments of four
};

/// Whether the algorithm has generations.
[[nodiscard]] bool has_population(Algorithm algorithm);
/// Candidates of a generation for so many variables; 0 where there are none.
[[nodiscard]] int population_of(const OptimizerOptions& options, std::size_t variables);

/// Candidates of the scan before the algorithm.
[[nodiscard]] int scan_size(const OptimizerOptions& options, std::size_t variables);

/// Keys of [optimizer] that cannot be had together, or not with so many objectives: `front` when each is wanted for
/// itself. Without a file.
[[nodiscard]] std::vector<Violation> contradictions(const OptimizerOptions& options, bool front);

/// Step of finite differences in unit coordinates that balances noise (1e-6 where it is not known) and truncation:
/// forward 2 sqrt(noise), central cbrt(3 noise), within [1e-7, 0.1].
[[nodiscard]] double difference_step(const OptimizerOptions& options);
/// max(step_tolerance, 0.1 sqrt(noise)), at most initial_step / 2: smaller steps cannot see above the noise.
[[nodiscard]] double stopping_step(const OptimizerOptions& options);

}  // namespace dovetail::optimizer

template <>
std::span<const dovetail::Field<dovetail::optimizer::OptimizerOptions>>
dovetail::option_table<dovetail::optimizer::OptimizerOptions>();
