#pragma once

#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "optimizer/search/run.hpp"

namespace dovetail::optimizer {

/// A problem with a known optimum.
struct KnownProblem {
  Problem problem;
  Evaluator evaluator;
  std::vector<double> optimum;
  double value;
};

/// [Hock, Schittkowski 1981, problem 22]: two active constraints at (1, 1), f = 1.
inline KnownProblem hock_schittkowski_22() {
  KnownProblem known;
  known.problem.space = DesignSpace(
      {{.key = "x", .lower = -2, .upper = 3, .start = 2}, {.key = "y", .lower = -2, .upper = 3, .start = 2}});
  known.problem.objective = {{.response = "f"}};
  known.problem.constraints = {{.response = "sum", .lower = {}, .upper = 2},
                               {.response = "parabola", .lower = {}, .upper = 0, .scale = 1}};
  known.evaluator = [](std::span<const double> x) {
    Evaluation e;
    e.responses["f"] = std::pow(x[0] - 2, 2) + std::pow(x[1] - 1, 2);
    e.responses["sum"] = x[0] + x[1];
    e.responses["parabola"] = x[0] * x[0] - x[1];
    return e;
  };
  known.optimum = {1, 1};
  known.value = 1;
  return known;
}

/// [Hock, Schittkowski 1981, problem 35]: one active linear constraint at (4/3, 7/9, 4/9), f = 1/9.
inline KnownProblem hock_schittkowski_35() {
  KnownProblem known;
  known.problem.space = DesignSpace({{.key = "x", .lower = 0, .upper = 2, .start = 0.5},
                                     {.key = "y", .lower = 0, .upper = 2, .start = 0.5},
                                     {.key = "z", .lower = 0, .upper = 2, .start = 0.5}});
  known.problem.objective = {{.response = "f"}};
  known.problem.constraints = {{.response = "plane", .lower = {}, .upper = 3}};
  known.evaluator = [](std::span<const double> x) {
    Evaluation e;
    e.responses["f"] = 9 - 8 * x[0] - 6 * x[1] - 4 * x[2] + 2 * x[0] * x[0] + 2 * x[1] * x[1] + x[2] * x[2] +
                       2 * x[0] * x[1] + 2 * x[0] * x[2];
    e.responses["plane"] = x[0] + x[1] + 2 * x[2];
    return e;
  };
  known.optimum = {4.0 / 3, 7.0 / 9, 4.0 / 9};
  known.value = 1.0 / 9;
  return known;
}

/// Rosenbrock's valley, f = 0 at (1, 1), no constraint.
inline KnownProblem rosenbrock() {
  KnownProblem known;
  known.problem.space = DesignSpace(
      {{.key = "x", .lower = -2, .upper = 2, .start = -1.2}, {.key = "y", .lower = -1, .upper = 3, .start = 1}});
  known.problem.objective = {{.response = "f"}};
  known.evaluator = [](std::span<const double> x) {
    Evaluation e;
    e.responses["f"] = 100 * std::pow(x[1] - x[0] * x[0], 2) + std::pow(1 - x[0], 2);
    return e;
  };
  known.optimum = {1, 1};
  known.value = 0;
  return known;
}

}  // namespace dovetail::optimizer
