#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "optimizer/search/run.hpp"

namespace dovetail::optimizer {

/// A bowl over [-1, 3] x [0, 10] with its bottom, 1, at (1, 4); "height" = y is limited to 6.
inline Problem bowl_problem() {
  Problem problem;
  problem.space = DesignSpace({{.key = "geometry.a_um", .lower = -1, .upper = 3, .start = 0},
                               {.key = "geometry.b_deg", .lower = 0, .upper = 10, .start = 8}});
  problem.objective = {{.response = "bowl"}};
  problem.constraints = {{.response = "height", .lower = {}, .upper = 6}};
  return problem;
}

inline Evaluation bowl(std::span<const double> x) {
  Evaluation e;
  e.responses["bowl"] = 1 + std::pow(x[0] - 1, 2) + std::pow((x[1] - 4) / 3, 2);
  e.responses["height"] = x[1];
  return e;
}

/// A candidate that breaks a rule by `violation`: no physics.
inline Evaluation broken(double violation) {
  Evaluation e;
  e.status = status_of(Outcome::infeasible);
  e.feasible = false;
  e.constraints["rule:wall"] = violation;
  return e;
}

/// Of what fails after it was meshed the rules are known, and kept.
inline Evaluation failed() {
  Evaluation e;
  e.constraints["rule:wall"] = -1;
  e.status = failed_at("steady_state", Status::iteration_limit);
  return e;
}

/// So many at once, told of last first, as others who work may be.
inline BatchEvaluator in_batches(const Evaluator& evaluator, std::size_t size) {
  return [=](const std::vector<std::vector<double>>& points, const std::function<bool(std::size_t, Evaluation)>& told) {
    bool goes_on = true;
    for (std::size_t first = 0; goes_on && first < points.size(); first += size) {
      std::vector<Evaluation> found;
      for (std::size_t i = first; i < std::min(first + size, points.size()); ++i) found.push_back(evaluator(points[i]));
      for (std::size_t i = found.size(); i-- > 0;) goes_on = told(first + i, std::move(found[i])) && goes_on;
    }
  };
}

/// Those that search for one objective.
inline std::vector<Algorithm> all_algorithms() {
  std::vector<Algorithm> all;
  for (const auto& entry : enum_names(Algorithm{}))
    if (entry.value != Algorithm::nsga2) all.push_back(entry.value);
  return all;
}

inline OptimizerOptions bowl_options(Algorithm algorithm) {
  OptimizerOptions options;
  options.max_evaluations = 120;
  options.scan_evaluations = algorithm == Algorithm::scan ? 0 : 6;  // a scan alone takes the whole budget
  options.algorithm = algorithm;
  return options;
}

}  // namespace dovetail::optimizer
