#include "optimizer/search/nlopt_search.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <nlopt.hpp>

#include "optimizer/search/params.hpp"

namespace dovetail::optimizer {

namespace {

enum class Constraints { own, augmented_lagrangian, exact_penalty };

struct NloptAlgorithm {
  Algorithm name;
  nlopt::algorithm id;
  Constraints constraints;
  bool gradient, global;
};

constexpr std::array kAlgorithms{
    NloptAlgorithm{Algorithm::cobyla, nlopt::LN_COBYLA, Constraints::own, false, false},
    NloptAlgorithm{Algorithm::bobyqa, nlopt::LN_BOBYQA, Constraints::augmented_lagrangian, false, false},
    NloptAlgorithm{Algorithm::neldermead, nlopt::LN_NELDERMEAD, Constraints::augmented_lagrangian, false, false},
    NloptAlgorithm{Algorithm::sbplx, nlopt::LN_SBPLX, Constraints::augmented_lagrangian, false, false},
    NloptAlgorithm{Algorithm::isres, nlopt::GN_ISRES, Constraints::own, false, true},
    NloptAlgorithm{Algorithm::direct_l, nlopt::GN_DIRECT_L, Constraints::exact_penalty, false, true},
    NloptAlgorithm{Algorithm::crs2, nlopt::GN_CRS2_LM, Constraints::exact_penalty, false, true},
    NloptAlgorithm{Algorithm::mma, nlopt::LD_MMA, Constraints::own, true, false},
    NloptAlgorithm{Algorithm::slsqp, nlopt::LD_SLSQP, Constraints::own, true, false},
};

const NloptAlgorithm* find(Algorithm name) {
  const auto found = std::ranges::find(kAlgorithms, name, &NloptAlgorithm::name);
  return found == kAlgorithms.end() ? nullptr : &*found;
}

/// How constraints enter the objective; nothing by default.
struct Penalty {
  std::vector<double> multipliers;  ///< augmented Lagrangian when not empty
  double weight = 0;                ///< rho, or the weight of the exact penalty
  [[nodiscard]] double operator()(const SearchValue& value) const {
    if (multipliers.empty()) return penalised(value, weight);
    double sum = 0;
    for (std::size_t j = 0; j < value.constraints.size(); ++j) {
      const double shifted = std::max(0.0, value.constraints[j] + multipliers[j] / weight);
      sum += weight / 2 * shifted * shifted;
    }
    return value.objective + sum;
  }
};

struct Callback {
  SearchFunctions* functions;
  CallbackGuard guard;
  Penalty penalty;
};

double objective(unsigned n, const double* u, double* gradient, void* data) {
  auto& callback = *static_cast<Callback*>(data);
  double result = 0;
  const bool well = callback.guard.run([&] {
    const std::span<const double> unit(u, n);
    result = callback.penalty(callback.functions->value(unit));
    if (gradient != nullptr) {
      const SearchGradient g = callback.functions->gradient(unit);
      std::copy(g.objective.begin(), g.objective.end(), gradient);
    }
  });
  if (!well) throw nlopt::forced_stop();
  return result;
}

void constraints(unsigned m, double* c, unsigned n, const double* u, double* gradient, void* data) {
  auto& callback = *static_cast<Callback*>(data);
  const bool well = callback.guard.run([&] {
    const std::span<const double> unit(u, n);
    const SearchValue value = callback.functions->value(unit);
    assert(value.constraints.size() == m);
    std::copy(value.constraints.begin(), value.constraints.end(), c);
    if (gradient != nullptr) {
      const SearchGradient g = callback.functions->gradient(unit);
      for (std::size_t j = 0; j < m; ++j) std::copy(g.constraints[j].begin(), g.constraints[j].end(), gradient + j * n);
    }
  });
  if (!well) throw nlopt::forced_stop();
}

SearchOutcome outcome_of(nlopt::result result, const std::string& name) {
  switch (result) {
    case nlopt::SUCCESS:
    case nlopt::STOPVAL_REACHED:
    case nlopt::FTOL_REACHED:
    case nlopt::XTOL_REACHED:
      return {.status = Status::converged, .message = name + ": stopping rule reached"};
    case nlopt::MAXEVAL_REACHED:
    case nlopt::MAXTIME_REACHED:
      return {.status = Status::iteration_limit, .message = name + ": limit reached"};
    default:
      return {.status = Status::stalled, .message = name + ": gave up"};
  }
}

/// One call of the library; `point` becomes its answer.
SearchOutcome minimise(const NloptAlgorithm& algorithm, SearchFunctions& functions, const Penalty& penalty,
                       std::vector<double>& point, double step, std::uint64_t seed) {
  const OptimizerOptions& options = functions.options();
  const auto n = static_cast<unsigned>(functions.size());
  const std::string name(to_string(algorithm.name));
  Callback callback{.functions = &functions, .guard = {}, .penalty = penalty};
  nlopt::opt search(algorithm.id, n);
  search.set_lower_bounds(0.0);
  search.set_upper_bounds(1.0);
  search.set_min_objective(objective, &callback);
  if (algorithm.constraints == Constraints::own)
    search.add_inequality_mconstraint(
        constraints, &callback,
        std::vector<double>(functions.constraint_count(), LibraryParams{}.constraint_tolerance));
  search.set_xtol_abs(std::min(stopping_step(options), step / 2));
  // A noisy objective repeats itself long before an optimum, so the change of the objective only stops methods that
  // take whole Newton-like steps.
  if (algorithm.gradient) search.set_ftol_rel(std::max(options.tolerance, options.noise));
  if (!algorithm.global) search.set_initial_step(step);
  nlopt::srand(static_cast<unsigned long>(seed));
  SearchOutcome outcome;
  double value = 0;
  try {
    outcome = outcome_of(search.optimize(point, value), name);
  } catch (const nlopt::forced_stop&) {
    outcome.message = name + ": stopped";
  } catch (const nlopt::roundoff_limited&) {
    outcome.message = name + ": steps fell below what double precision resolves";
  } catch (const std::exception& error) {
    outcome.message = name + ": " + error.what();
  }
  callback.guard.rethrow();
  return outcome;
}

SearchOutcome augmented_lagrangian(const NloptAlgorithm& algorithm, SearchFunctions& functions,
                                   std::vector<double> point, double step, std::uint64_t seed) {
  constexpr PenaltyParams kParams;
  Penalty penalty{.multipliers = std::vector<double>(functions.constraint_count(), 0.0), .weight = kParams.weight};
  const double smallest = stopping_step(functions.options());
  const double enough = functions.options().constraint_margin / 2;
  double last_violation = std::numeric_limits<double>::infinity();
  SearchOutcome outcome;
  for (int round = 0; round < kParams.rounds; ++round) {
    const std::vector<double> before = point;
    outcome = minimise(algorithm, functions, penalty, point, step, seed);
    const std::vector<double> c = functions.value(point).constraints;
    double violation = 0;
    double change = 0;
    for (std::size_t j = 0; j < c.size(); ++j) {
      violation = std::max(violation, c[j]);
      const double multiplier = std::max(0.0, penalty.multipliers[j] + penalty.weight * c[j]);
      change = std::max(change, std::abs(multiplier - penalty.multipliers[j]));
      penalty.multipliers[j] = multiplier;
    }
    double moved = 0;
    for (std::size_t i = 0; i < point.size(); ++i) moved = std::max(moved, std::abs(point[i] - before[i]));
    if (change == 0 || (round > 0 && violation <= enough && moved <= 2 * smallest)) return outcome;
    if (violation > kParams.falls * last_violation)
      penalty.weight = std::min(kParams.growth * penalty.weight, kParams.most);
    last_violation = violation;
    step = std::max(step / 2, kParams.smallest_step * smallest);
  }
  return outcome;
}

}  // namespace

bool is_global(Algorithm algorithm) {
  return find(algorithm) != nullptr && find(algorithm)->global;
}

SearchOutcome nlopt_search(Algorithm algorithm, SearchFunctions& functions, const std::vector<double>& start,
                           double step, std::uint64_t seed) {
  const NloptAlgorithm* found = find(algorithm);
  assert(found != nullptr);
  if (found->constraints == Constraints::augmented_lagrangian)
    return augmented_lagrangian(*found, functions, start, step, seed);
  Penalty penalty;
  if (found->constraints == Constraints::exact_penalty) penalty.weight = PenaltyParams{}.weight;
  std::vector<double> point = start;
  return minimise(*found, functions, penalty, point, step, seed);
}

}  // namespace dovetail::optimizer
