#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "bowl.hpp"

namespace dovetail::optimizer {

/// The bowl's bottom lies at height 4; with this limit the best point is where the limit is.
inline Problem low_bowl() {
  Problem problem = bowl_problem();
  problem.constraints = {{.response = "height", .lower = {}, .upper = 3}};
  return problem;
}

inline OptimizerOptions short_search() {
  OptimizerOptions result = bowl_options(Algorithm::cobyla);
  result.max_evaluations = 60;
  return result;
}

/// Finer meshes see higher walls, and the more so the further from x = 0: what was measured at the start is wrong where
/// the search ends.
inline Evaluation finer_bowl(std::span<const double> x, int level) {
  Evaluation e = bowl(x);
  e.responses["height"] += 0.1 * level + 0.1 * std::abs(x[0]);
  return e;
}

/// The first candidate that is looked at changes by so much, all others by next to nothing.
inline FinerEvaluator first_changes(const Evaluator& evaluator, const std::string& response, double by) {
  return [=, first = std::vector<double>()](std::span<const double> x, int) mutable {
    if (first.empty()) first.assign(x.begin(), x.end());
    Evaluation e = evaluator(x);
    e.responses[response] += std::ranges::equal(x, first) ? by : 0.01;
    return e;
  };
}

}  // namespace dovetail::optimizer
