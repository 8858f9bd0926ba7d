#include "optimizer/search/pagmo_search.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <optional>
#include <pagmo/algorithm.hpp>
#include <pagmo/algorithms/cmaes.hpp>
#include <pagmo/algorithms/de.hpp>
#include <pagmo/algorithms/nsga2.hpp>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>
#include <pagmo/utils/hypervolume.hpp>
#include <pagmo/utils/multi_objective.hpp>

#include "optimizer/search/params.hpp"

namespace dovetail::optimizer {

namespace {

using Points = std::vector<std::vector<double>>;
/// Fitness of many points, in their order.
using AtOnce = std::function<Points(const Points&)>;

/// What pagmo asks, and what it is told.
struct Questions {
  bool foreseeing = false;
  Points asked;                                              ///< while foreseeing
  std::map<std::vector<double>, std::vector<double>> known;  ///< of this generation
};

/// The unit cube with `objectives`, as pagmo takes a problem: copied at will.
struct CubeProblem {
  Questions* questions = nullptr;
  const AtOnce* values = nullptr;
  std::size_t variables = 1, objectives = 1;

  [[nodiscard]] pagmo::vector_double fitness(const pagmo::vector_double& u) const {
    if (questions->foreseeing) {
      questions->asked.push_back(u);
      return pagmo::vector_double(objectives, std::numeric_limits<double>::max());
    }
    if (const auto found = questions->known.find(u); found != questions->known.end()) return found->second;
    return (*values)({u}).front();
  }
  [[nodiscard]] std::pair<pagmo::vector_double, pagmo::vector_double> get_bounds() const {
    return {pagmo::vector_double(variables, 0.0), pagmo::vector_double(variables, 1.0)};
  }
  [[nodiscard]] pagmo::vector_double::size_type get_nobj() const { return objectives; }
};

/// Evolves until `ended`, or until a generation asks nothing: then the algorithm's own rule says that it is done.
void evolve(const pagmo::algorithm& algorithm, pagmo::population& population, Questions& questions,
            const AtOnce& values, const std::function<bool(const pagmo::population&)>& ended) {
  for (;;) {
    questions.asked.clear();
    questions.foreseeing = true;
    static_cast<void>(pagmo::algorithm(algorithm).evolve(population));
    questions.foreseeing = false;
    if (questions.asked.empty()) return;
    const Points found = values(questions.asked);
    questions.known.clear();
    for (std::size_t i = 0; i < found.size(); ++i) questions.known.emplace(questions.asked[i], found[i]);
    population = algorithm.evolve(population);
    if (ended(population)) return;
  }
}

unsigned short_seed(std::uint64_t seed) {
  return static_cast<unsigned>(seed ^ (seed >> 32));
}

double nearest_in_box(double u) {
  return std::clamp(u, 0.0, 1.0);
}

AtOnce penalties_of(SearchFunctions& functions) {
  return [&functions](const Points& points) {
    Points fitness;
    for (const SearchValue& value : functions.values(points))
      fitness.push_back({penalised(value, PenaltyParams{}.weight)});
    return fitness;
  };
}

SearchOutcome done(Algorithm algorithm) {
  return {.status = Status::converged, .message = std::string(to_string(algorithm)) + ": stopping rule reached"};
}

SearchOutcome too_few(Algorithm algorithm) {
  return {.status = Status::iteration_limit,
          .message = std::string(to_string(algorithm)) + ": the budget does not reach beyond its first generation"};
}

/// Fitness of a front: the objectives of who keeps the limits. Of anybody else every one is far beyond those, by what
/// is broken, which is constrained domination [Deb 2002]: less broken is better, and any broken limit worse than none.
std::vector<double> front_fitness(const Candidate& candidate, const std::vector<double>& scale) {
  const Judgement& judgement = candidate.judgement;
  constexpr double kBeyond = 1e6;
  std::vector<double> fitness(scale.size());
  const double violation = judgement.computed || candidate.evaluation.infeasible()
                               ? std::min(judgement.violation, SubstituteParams{}.most_violation)
                               : 2 * SubstituteParams{}.most_violation;  // failed: nothing is known
  for (std::size_t i = 0; i < scale.size(); ++i)
    fitness[i] = judgement.feasible ? judgement.terms[i] / scale[i] : kBeyond + violation;
  return fitness;
}

/// Sizes of the objectives that are known, for numbers about one.
std::vector<double> sizes(const EvaluationSession& session) {
  std::vector<double> largest(session.problem().objective.size(), 0.0);
  for (const Candidate& candidate : session.candidates())
    if (candidate.judgement.computed)
      for (std::size_t i = 0; i < largest.size(); ++i)
        largest[i] = std::max(largest[i], std::abs(candidate.judgement.terms[i]));
  for (double& size : largest)
    if (!std::isnormal(size)) size = 1;
  return largest;
}

}  // namespace

SearchOutcome cmaes_search(SearchFunctions& functions, const std::vector<double>& start, double step,
                           std::uint64_t seed) {
  const OptimizerOptions& options = functions.options();
  const AtOnce inside = penalties_of(functions);
  // Samples may leave the box: they are answered by the nearest design and how far it is, so that the mean comes back.
  const AtOnce values = [&](const Points& points) {
    Points moved = points;
    for (std::vector<double>& u : moved) std::ranges::transform(u, u.begin(), nearest_in_box);
    Points fitness = inside(moved);
    for (std::size_t k = 0; k < points.size(); ++k)
      for (std::size_t i = 0; i < points[k].size(); ++i)
        fitness[k][0] += PenaltyParams{}.weight * std::pow(points[k][i] - moved[k][i], 2);
    return fitness;
  };
  Questions questions;
  pagmo::population population(CubeProblem{&questions, &values, functions.size(), 1}, 0, short_seed(seed));
  // It begins at its best one and looks at no other.
  const std::vector<double> fitness = values({start}).front();
  for (int i = 0; i < population_of(options, functions.size()); ++i) population.push_back(start, fitness);
  const pagmo::algorithm algorithm(
      pagmo::cmaes(1, -1, -1, -1, -1, step, 0, stopping_step(options), true, false, short_seed(seed)));
  evolve(algorithm, population, questions, values, [](const pagmo::population&) { return false; });
  return done(Algorithm::cmaes);
}

SearchOutcome de_search(SearchFunctions& functions, EvaluationSession& session, std::uint64_t seed) {
  const OptimizerOptions& options = functions.options();
  const auto count = static_cast<std::size_t>(population_of(options, functions.size()));
  if (session.candidates().size() < count) return too_few(Algorithm::de);
  const AtOnce values = penalties_of(functions);
  Points known;
  for (std::size_t i = 0; i < session.candidates().size(); ++i) known.push_back(session.unit(i));
  const Points fitness = values(known);
  std::vector<std::size_t> order(known.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return fitness[i].front(); });
  Questions questions;
  pagmo::population population(CubeProblem{&questions, &values, functions.size(), 1}, 0, short_seed(seed));
  for (std::size_t i = 0; i < count; ++i) population.push_back(known[order[i]], fitness[order[i]]);
  constexpr DifferentialParams kParams;
  const pagmo::algorithm algorithm(
      pagmo::de(1, kParams.weight, kParams.crossover, kParams.variant, 0, 0, short_seed(seed)));
  const auto together = [&](const pagmo::population& now) {
    for (std::size_t i = 0; i < functions.size(); ++i) {
      const auto [least, most] =
          std::ranges::minmax(now.get_x(), {}, [i](const pagmo::vector_double& u) { return u[i]; });
      if (most[i] - least[i] > stopping_step(options)) return false;
    }
    return true;
  };
  evolve(algorithm, population, questions, values, together);
  return done(Algorithm::de);
}

SearchOutcome nsga2_search(EvaluationSession& session, std::uint64_t seed) {
  const std::size_t variables = session.problem().space.size();
  const auto count = static_cast<std::size_t>(population_of(session.options(), variables));
  if (session.candidates().size() < count) return too_few(Algorithm::nsga2);
  const std::vector<double> scale = sizes(session);
  const AtOnce values = [&](const Points& points) {
    Points fitness;
    for (const std::size_t index : session.evaluate_all(points, std::string(to_string(Algorithm::nsga2))))
      fitness.push_back(front_fitness(session[index], scale));
    return fitness;
  };
  Points fitness;
  for (const Candidate& candidate : session.candidates()) fitness.push_back(front_fitness(candidate, scale));
  Questions questions;
  pagmo::population population(CubeProblem{&questions, &values, variables, scale.size()}, 0, short_seed(seed));
  for (const auto index : pagmo::select_best_N_mo(fitness, count))
    population.push_back(session.unit(index), fitness[index]);
  constexpr GeneticParams kParams;
  const double mutation = 1 / static_cast<double>(variables);
  const pagmo::algorithm algorithm(
      pagmo::nsga2(1, kParams.crossover, kParams.crossover_index, mutation, kParams.mutation_index, short_seed(seed)));
  evolve(algorithm, population, questions, values, [](const pagmo::population&) { return false; });
  return done(Algorithm::nsga2);
}

double hypervolume(const std::vector<std::vector<double>>& points, const std::vector<double>& reference) {
  Points counting;
  for (const std::vector<double>& point : points)
    if (std::ranges::equal(point, reference, std::less<>())) counting.push_back(point);
  if (counting.empty()) return 0;
  return pagmo::hypervolume(counting, true).compute(reference);
}

}  // namespace dovetail::optimizer
