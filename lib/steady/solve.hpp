#pragma once

#include <Eigen/Core>
#include <memory>
#include <string_view>

#include "core/enum_names.hpp"
#include "steady/tangent.hpp"

namespace dovetail::steady {

/// Ways to a steady state, in the order in which they are tried. From `harmonics` on each starts from solutions of
/// neighbouring problems, cheapest first. All end with the problem as it was asked, at worst with another eps: the way
/// changes whether there is an answer and not what counts as one.
enum class Way {
  guess,           ///< from the displacement given
  closed,          ///< from closed contact
  other_penalty,   ///< with other eps, then with the one asked for from there
  harmonics,       ///< the series grows from one harmonic to H
  damping,         ///< dashpots across the contact fade away; where steps fail, along the curve of solutions
  softer_damping,  ///< the same with a tenth of eps
  none,
};
constexpr EnumNames<Way, 7> enum_names(Way) {
  return {{{Way::guess, "guess"},
           {Way::closed, "closed"},
           {Way::other_penalty, "other_penalty"},
           {Way::harmonics, "harmonics"},
           {Way::damping, "damping"},
           {Way::softer_damping, "softer_damping"},
           {Way::none, "none"}}};
}
[[nodiscard]] constexpr std::string_view to_string(Way way) {
  return name_of(way);
}

/// What solving took.
struct Work {
  int iterations = 0;    ///< Jacobians, all penalties tried together
  int evaluations = 0;   ///< residuals
  int intermediate = 0;  ///< states on the way to this one that are not reported (paths/frequency_response.hpp)
  Way way = Way::none;   ///< that led to it
};

/// Where an attempt to solve f(U) = 0, or all attempts on the ways to a solution, ended.
struct Attempt : Work {
  Status status = Status::iteration_limit;
  double residual = 0;                          ///< |f| / force scale
  Point point = {};                             ///< the best one
  std::shared_ptr<const Tangent> tangent = {};  ///< the last one factorised on the way, or null
};

enum class Method { newton, powell, powell_fd };

/// Solves from `start` U [nc, 2H+1] to the tolerance of the problem's options, relative to the excitation; it is raised
/// to what rounding of the forces leaves when that is more. `reuse`, of a nearby point with the same pseudo-penalty,
/// may spare the first factorisations; it changes the way to the solution and not the solution.
[[nodiscard]] Attempt solve(const std::shared_ptr<const Problem>& problem, const Eigen::MatrixXd& start, Method method,
                            int max_iterations, const std::shared_ptr<const Tangent>& reuse = {});

}  // namespace dovetail::steady
